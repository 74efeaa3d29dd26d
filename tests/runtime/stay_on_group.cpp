// SPDX-License-Identifier: GPL-2.0-or-later
/// Matrices that are reconstructed beside a motion stay on their groups, whatever the method, and keep its order.
#include "lagen/group/stay_on_group.hpp"
#include "lagen/integrate.hpp"
#include "support/order.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

/// R' = R hat(xi) with xi = (b', a' sin b, a' cos b), whose solution is R = Rz(a) Rx(b), a = t + t^2/4, b = sin t. The
/// other lane is x' = xi_3, by itself.
template <bool stays>
struct Turning {
    using Scalar = double;
    static constexpr int dimension = 10, base_dimension = 1, fibre_dimension = 9;
    using State = Eigen::Matrix<double, 10, 1>;
    static constexpr std::array<GroupEntry, 6> generators = {
        {{0, 1, 2, -1.0}, {0, 2, 1, 1.0}, {1, 0, 2, 1.0}, {1, 2, 0, -1.0}, {2, 0, 1, -1.0}, {2, 1, 0, 1.0}}};

    static Eigen::Matrix3d exact(double t)
    {
        const double a = t + t * t / 4, b = std::sin(t);
        Eigen::Matrix3d z, x;
        z << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
        x << 1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b);
        return z * x;
    }
    static State start()
    {
        State s = State::Zero();
        for (int i = 0; i < 3; ++i) s[1 + 4 * i] = 1;
        return s;
    }
    static Eigen::Matrix3d matrix(const State& s)
    {
        Eigen::Matrix3d R;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) R(i, j) = s[1 + 3 * i + j];
        return R;
    }
    static std::array<double, 3> velocity(double t)
    {
        const double b = std::sin(t), turn = 1 + t / 2;
        return {std::cos(t), turn * std::sin(b), turn * std::cos(b)};
    }
    status_t<double> rhs(double t, const State& s, State& ds) const noexcept
    {
        const std::array<double, 3> w = velocity(t);
        State rates;
        rates[0] = w[2];
        for (int i = 0; i < 3; ++i) {
            const double* R = &s[1 + 3 * i];
            rates[1 + 3 * i] = R[1] * w[2] - R[2] * w[1];
            rates[2 + 3 * i] = R[2] * w[0] - R[0] * w[2];
            rates[3 + 3 * i] = R[0] * w[1] - R[1] * w[0];
        }
        ds = rates;
        return Status::ok;
    }
    static constexpr std::array<int, 18> jacobian_rows = {1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9};
    static constexpr std::array<int, 18> jacobian_columns = {2, 3, 3, 1, 1, 2, 5, 6, 6, 4, 4, 5, 8, 9, 9, 7, 7, 8};
    void jacobian_values(double t, const State&, std::array<double, 18>& values) const noexcept
    {
        const std::array<double, 3> w = velocity(t);
        const std::array<double, 6> row = {w[2], -w[1], w[0], -w[2], w[1], -w[0]};
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = row[k % 6];
    }
    static void stay_on_groups(const State& s0, State& s1) noexcept requires stays
    {
        stay_on_group<3>(generators, s0, s1, 1);
    }
};

using Body = Turning<true>;

double defect(const Eigen::Matrix3d& R)
{
    return (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
}

template <class M, class Method>
double order_of(Method method, double first)
{
    std::vector<support::ErrorPoint> points;
    for (double h = first; points.size() < 5; h /= 2) {
        method.step = h;
        const auto run = integrate(M{}, M::start(), {0.0, 2.0}, method);
        REQUIRE(run);
        points.push_back({h, (M::matrix(run.state) - M::exact(2)).norm()});
    }
    return support::measured_order(points, 1e-13L);
}

} // namespace

TEST_CASE("a matrix that is put back onto its group keeps the order of the method", "[group]")
{
    CHECK(order_of<Body>(Euler{}, 0.02) == Approx(1).margin(0.1));
    CHECK(order_of<Body>(Heun{}, 0.05) == Approx(2).margin(0.1));
    CHECK(order_of<Body>(Rk4{}, 0.1) == Approx(4).margin(0.15));
    CHECK(order_of<Body>(Gauss4{}, 0.1) == Approx(4).margin(0.15));
    CHECK(order_of<Body>(Gauss6{}, 0.2) == Approx(6).margin(0.25));
}

TEST_CASE("a hundred thousand steps leave a rotation on SO(3), where the same steps without the group lose it",
          "[group]")
{
    const double end = 10;
    const auto run = integrate(Body{}, Body::start(), {0.0, end}, Rk4{.step = end / 1e5});
    REQUIRE(run);
    CHECK(run.steps == 100'000);
    CHECK(defect(Body::matrix(run.state)) < 1e-12);
    CHECK((Body::matrix(run.state) - Body::exact(end)).norm() < 1e-11);
    const auto coarse = integrate(Body{}, Body::start(), {0.0, end}, Rk4{.step = 0.1});
    const auto lost = integrate(Turning<false>{}, Body::start(), {0.0, end}, Rk4{.step = 0.1});
    CHECK(defect(Body::matrix(coarse.state)) < 1e-13);
    CHECK(defect(Body::matrix(lost.state)) > 1e-5);
}

TEST_CASE("rows inside steps lie on the group too", "[group]")
{
    const std::vector<double> times = {0.123, 1.7, 2.9, 3.001};
    const auto run =
        integrate(Body{}, Body::start(), {0.0, 4.0}, Dop853{.tolerance = 1e-10}, Options<Body>{.at = times});
    REQUIRE(run);
    REQUIRE(run.states.size() == times.size());
    for (std::size_t k = 0; k < times.size(); ++k) {
        CHECK(defect(Body::matrix(run.states[k])) < 1e-14);
        CHECK((Body::matrix(run.states[k]) - Body::exact(times[k])).norm() < 1e-8);
    }
}
