// SPDX-License-Identifier: GPL-2.0-or-later
/// The implicit methods on stiff problems: stability, order reduction, published statistics and references.
#include "lagen/lagen.hpp"
#include "support/order.hpp"
#include "support/problems.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// x' = A x with A = (re, -im; im, re): the eigenvalue re + i im.
struct Spiral {
    using Scalar = double;
    using State = Eigen::Matrix<double, 2, 1>;
    static constexpr int dimension = 2;
    double re = 0, im = 0;

    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = State(re * s[0] - im * s[1], im * s[0] + re * s[1]);
        return Status::ok;
    }
    static constexpr std::array<int, 4> jacobian_rows{0, 0, 1, 1}, jacobian_columns{0, 1, 0, 1};
    void jacobian_values(double, const State&, std::array<double, 4>& values) const noexcept
    {
        values = {re, -im, im, re};
    }
};

/// x'' = -x, z' = -z.
struct Joined {
    using Scalar = double;
    using State = Eigen::Matrix<double, 3, 1>;
    static constexpr int dimension = 3;

    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = State(s[1], -s[0], -s[2]);
        return Status::ok;
    }
    static constexpr std::array<int, 3> jacobian_rows{0, 1, 2}, jacobian_columns{1, 0, 2};
    void jacobian_values(double, const State&, std::array<double, 3>& values) const noexcept { values = {1, -1, -1}; }
};

/// |R(z)| by one step of length 1.
template <class Method>
double growth(double re, double im)
{
    const auto run = integrate(Spiral{re, im}, Eigen::Vector2d(1, 0), {0.0, 1.0}, Method{.step = 1});
    REQUIRE(run.status() == Status::ok);
    return run.state.norm();
}

/// Measured on y' = lambda (y - g) + g' from 0 to 1 in long double.
template <class Method>
double stiff_order()
{
    using Problem = problems::ProtheroRobinson<long double>;
    std::vector<support::ErrorPoint> points;
    for (int k = 0; k < 5; ++k) {
        const double h = 0.125 / (1 << k);
        const Problem::State start(Problem::exact(0));
        const auto run = integrate(Problem{}, start, {0.0L, 1.0L}, Method{.step = h});
        REQUIRE(run.status() == Status::ok);
        points.push_back({h, std::abs(run.state[0] - Problem::exact(1))});
    }
    return support::measured_order(points, 1e-18L);
}

auto near(double order)
{
    return Catch::WithinAbs(order, tolerance::order);
}

} // namespace

TEST_CASE("Gauss' methods neither damp nor excite any oscillation")
{
    for (const double y : {0.1, 1.0, 3.0, 10.0, 1e3, 1e6}) {
        const auto one = Catch::WithinAbs(1, 1e-14 * std::max(10.0, y));
        CHECK_THAT(growth<Gauss2>(0, y), one);
        CHECK_THAT(growth<Gauss4>(0, y), one);
        CHECK_THAT(growth<Gauss6>(0, y), one);
        CHECK_THAT(growth<Gauss8>(0, y), one);
    }
    // R(z) itself: (2 + z) / (2 - z), and (12 + 6 z + z^2) / (12 - 6 z + z^2), at z = -1.
    CHECK_THAT(growth<Gauss2>(-1, 0), Catch::WithinAbs(1.0 / 3, 1e-15));
    CHECK_THAT(growth<Gauss4>(-1, 0), Catch::WithinAbs(7.0 / 19, 1e-15));
    CHECK_THAT(growth<Gauss6>(-1, 0), Catch::WithinAbs(71.0 / 193, 1e-15));
    CHECK_THAT(growth<Gauss8>(-1, 0), Catch::WithinAbs(1001.0 / 2721, 1e-15));
}

TEST_CASE("Radau IIA of order 3 is L-stable: |R| = (1 + z/3) / (1 - 2z/3 + z^2/6), below 1 on the left")
{
    const auto stability = [](double z) { return (1 + z / 3) / (1 - 2 * z / 3 + z * z / 6); };
    for (const double z : {-0.5, -1.0, -10.0, -1e3, -1e6})
        CHECK_THAT(growth<Radau3Fixed>(z, 0), Catch::WithinAbs(std::abs(stability(z)), 1e-15));
    CHECK(growth<Radau3Fixed>(-1e6, 0) < 3e-6);
    for (const double y : {0.1, 1.0, 3.0, 10.0, 1e3}) {
        CHECK(growth<Radau3Fixed>(0, y) < 1);
        CHECK(growth<Radau3Fixed>(-y / 10, y) < growth<Radau3Fixed>(0, y));
    }
}

TEST_CASE(
    "Radau IIA of order 5 is L-stable: |R| = (1 + 2z/5 + z^2/20) / (1 - 3z/5 + 3z^2/20 - z^3/60), below 1 on the left")
{
    const auto stability = [](double z) {
        return (1 + 2 * z / 5 + z * z / 20) / (1 - 3 * z / 5 + 3 * z * z / 20 - z * z * z / 60);
    };
    for (const double z : {-0.5, -1.0, -10.0, -1e3, -1e6})
        CHECK_THAT(growth<Radau5Fixed>(z, 0), Catch::WithinAbs(std::abs(stability(z)), 1e-15));
    CHECK(growth<Radau5Fixed>(-1e6, 0) < 4e-6);
    for (const double y : {0.1, 1.0, 3.0, 10.0, 1e3}) {
        CHECK(growth<Radau5Fixed>(0, y) < 1);
        CHECK(growth<Radau5Fixed>(-y / 10, y) < growth<Radau5Fixed>(0, y));
    }
}

TEST_CASE(
    "The order falls to 2, 2, 4, 4 for Gauss and to 2, 3 for Radau IIA where the problem is stiff beyond the step")
{
    CHECK_THAT(stiff_order<Gauss2>(), near(2));
    CHECK_THAT(stiff_order<Gauss4>(), near(2));
    CHECK_THAT(stiff_order<Gauss6>(), near(4));
    CHECK_THAT(stiff_order<Gauss8>(), near(4));
    CHECK_THAT(stiff_order<Radau3Fixed>(), near(2));
    CHECK_THAT(stiff_order<Radau5Fixed>(), near(3));
}

TEST_CASE("Radau5 takes the steps of Hairer's radau5 on van der Pol's equation: 280 steps, 242 accepted, 2248 calls")
{
    // The Fortran driver with y(0) = (2, -0.6), h = 1e-6, rtol = atol = 1e-4 prints 2248 calls, 668 solved systems,
    // 280 steps, 242 accepted, and the last state.
    using Problem = problems::VanDerPol<double>;
    const auto run =
        integrate(Problem{}, Problem::State(2, -0.6), {0.0, 2.0}, Radau5{.tolerance = 1e-4, .first_step = 1e-6});
    CHECK(run.status() == Status::ok);
    CHECK(run.steps == 242);
    CHECK(run.steps + run.rejected == 280);
    CHECK(run.rhs_calls == 2248);
    CHECK(run.newton_iterations == 668);
    CHECK(run.decompositions == 252);
    CHECK_THAT(run.state[0], Catch::WithinAbs(1.706163410178079, 1e-11));
    CHECK_THAT(run.state[1], Catch::WithinAbs(-0.8927971289301175, 1e-11));
}

TEST_CASE("Radau5 meets its tolerance on van der Pol's equation and Robertson's reaction, at a price that grows slowly")
{
    // References: 34 digits, tolerances 1e-18 and 1e-20, which agree in the digits written.
    using Problem = problems::VanDerPol<double>;
    using Reaction = problems::Robertson<double>;
    std::size_t before = 0;
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
        const auto run = integrate(Problem{}, Problem::State(2, 0), {0.0, 2.0}, Radau5{.tolerance = tolerance});
        REQUIRE(run.status() == Status::ok);
        CHECK_THAT(run.state[0], Catch::WithinAbs(1.706167732170465008655, 10 * tolerance));
        CHECK_THAT(run.state[1], Catch::WithinAbs(-0.892809701024816549863, 10 * tolerance));
        CHECK(static_cast<double>(run.steps) < 3000 * std::pow(1e-10 / tolerance, 1.0 / 6));
        CHECK(run.steps > before);
        before = run.steps;

        const auto slow = integrate(Reaction{}, Reaction::State(1, 0, 0), {0.0, 40.0},
                                    Radau5{.tolerance = tolerance, .absolute = 1e-6 * tolerance});
        REQUIRE(slow.status() == Status::ok);
        CHECK_THAT(slow.state[0], Catch::WithinRel(0.715827068719405090471, 10 * tolerance));
        CHECK_THAT(slow.state[1], Catch::WithinRel(9.18553476455776455e-6, 10 * tolerance));
        CHECK_THAT(slow.state[2], Catch::WithinRel(0.284163745745830351765, 10 * tolerance));
    }
}

TEST_CASE("Explicit methods pay for stiffness what Radau5 does not")
{
    using Problem = problems::VanDerPol<double>;
    const Problem mild{1e-4};
    const auto implicit = integrate(mild, Problem::State(2, -0.66), {0.0, 0.5}, Radau5{.tolerance = 1e-6});
    const auto explicit_run = integrate(mild, Problem::State(2, -0.66), {0.0, 0.5}, Dopri5{.tolerance = 1e-6});
    CHECK(implicit.status() == Status::ok);
    CHECK(100 * implicit.rhs_calls < explicit_run.rhs_calls);
    CHECK((implicit.state - explicit_run.state).norm() < 1e-5);
}

TEST_CASE("The dense output of Radau5 is of order 3")
{
    using Pendulum = problems::Pendulum<long double>;
    std::vector<support::ErrorPoint> points;
    for (int k = 0; k < 4; ++k) {
        const double h = 1e-3 / (1 << k);
        const std::array<long double, 1> at{0.52L * static_cast<long double>(h)};
        const Radau5 method{.tolerance = 1e-16, .first_step = h};
        const auto run = integrate(Pendulum{}, {1.0L, 0.5L}, {0.0L, h}, method, {.at = at});
        REQUIRE(run.steps == 1);
        const auto exact = integrate(Pendulum{}, {1.0L, 0.5L}, {0.0L, at[0]}, Gauss8{.step = 1});
        points.push_back({h, (run.states[0] - exact.state).norm()});
    }
    CHECK_THAT(support::measured_order(points, 1e-18L) - 1, near(3));
}

TEST_CASE("The error of Radau5 does not grow where the relative tolerance falls below the absolute one, zero included")
{
    using Pendulum = problems::Pendulum<double>;
    const Pendulum::State start(1, 0);
    const auto exact = integrate(Pendulum{}, start, {0.0, 10.0}, Dop853{.tolerance = 1e-14});
    const auto error = [&](double relative, double absolute) {
        const auto run = integrate(Pendulum{}, start, {0.0, 10.0}, Radau5{.relative = relative, .absolute = absolute});
        CHECK(run.status() == Status::ok);
        return (run.state - exact.state).norm();
    };
    for (const double absolute : {1e-4, 1e-6, 1e-8}) {
        double before = error(absolute, absolute);
        CHECK(before > 0.01 * absolute);
        CHECK(before < 100 * absolute);
        for (const double share : {1e-1, 1e-2, 1e-4, 1e-8, 1e-24, 1e-94, 1e-290, 0.0}) {
            const double now = error(share * absolute, absolute);
            CHECK(now > 0.01 * absolute);
            CHECK(now <= 1.1 * before);
            before = now;
        }
    }
}

TEST_CASE("Radau5 needs no absolute tolerance for a lane that begins at zero, or stays there")
{
    for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
        const auto check = [&](const Joined::State& start) {
            const auto run = integrate(Joined{}, start, {0.0, 1.0}, Radau5{.relative = tolerance, .absolute = 0});
            CHECK(run.status() == Status::ok);
            const double c = std::cos(1.0), s = std::sin(1.0);
            const Joined::State exact(c * start[0] + s * start[1], c * start[1] - s * start[0], 0);
            CHECK((run.state - exact).norm() < 100 * tolerance);
            CHECK(run.state[2] == 0);
            CHECK(run.rejected < 10);
        };
        check(Joined::State(0, 1, 0));
        check(Joined::State(1, 0, 0));
        check(Joined::State(0, 1e-300, 0));
    }
}
