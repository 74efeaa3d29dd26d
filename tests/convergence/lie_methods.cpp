// SPDX-License-Identifier: GPL-2.0-or-later
/// Methods on groups: their orders, and what a hundred thousand steps keep.
#include "support/group_models.hpp"
#include "support/order.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;
using support::off_group, support::Vector;
using Body = support::TurningBody;
using Top = support::LiePoissonTop;

namespace {

template <class M, class Method>
typename M::State end_of(const M& model, const Method& method, double end)
{
    const auto run = integrate(model, M::start(), {0.0, end}, method);
    REQUIRE(run);
    return run.state;
}

template <class M, class Method>
double order_of(const M& model, Method method, double first)
{
    const typename M::State exact = end_of(model, Verner98{.tolerance = 3e-15}, 2);
    std::vector<support::ErrorPoint> points;
    for (method.step = first; points.size() < 5; method.step /= 2)
        points.push_back({method.step, (end_of(model, method, 2) - exact).norm()});
    return support::measured_order(points, 1e-12L);
}

} // namespace

TEST_CASE("methods on groups have the order of their tableau", "[group]")
{
    for (const double spring : {0.0, 1.4}) {
        const Body body{.spring = spring};
        CHECK(order_of(body, Rkmk4{}, 0.05) == Approx(4).margin(0.15));
        CHECK(order_of(body, GaussLie4{}, 0.1) == Approx(4).margin(0.15));
        CHECK(order_of(body, CrouchGrossman3{}, 0.05) == Approx(3).margin(0.15));
    }
    CHECK(order_of(Top{}, Rkmk4{}, 0.05) == Approx(4).margin(0.15));
    CHECK(order_of(Top{}, GaussLie4{}, 0.1) == Approx(4).margin(0.15));
    CHECK(order_of(Top{}, CrouchGrossman3{}, 0.05) == Approx(3).margin(0.15));
    CHECK(order_of(Top{}, LiePoisson2{}, 0.05) == Approx(2).margin(0.1));
    CHECK(order_of(Top{}, LiePoisson4{}, 0.2) == Approx(4).margin(0.15));
}

/// Of all methods by generated headers: tests/commands/test_run_groups.cpp.
TEST_CASE("a hundred thousand steps on groups keep Casimirs and attitudes to rounding", "[group]")
{
    const auto check_top = [](const auto& method, bool exact, double end = 1e4) {
        const Top::State s = end_of(Top{}, method, end);
        const Vector gamma = s.head<3>(), mu = s.tail<3>(), gamma0 = Top::start().head<3>(),
                     mu0 = Top::start().tail<3>();
        const double lost =
            std::max(std::abs(gamma.squaredNorm() - gamma0.squaredNorm()), std::abs(mu.dot(gamma) - mu0.dot(gamma0)));
        CAPTURE(lost, Top::energy(s) - Top::energy(Top::start()));
        CHECK((lost < 1e-12) == exact);
    };
    check_top(Rkmk4{.step = 0.1}, true);
    check_top(GaussLie4{.step = 0.1}, true, 1000);
    check_top(CrouchGrossman3{.step = 0.1}, true);
    check_top(LiePoisson4{.step = 0.1}, true, 1000);
    check_top(RkmkDop853{.tolerance = 1e-8}, true, 1000);
    check_top(Rk4{.step = 0.1}, false);
    const auto check_body = [](const auto& method, bool exact, double end = 1e4) {
        CHECK((off_group(Body::attitude(end_of(Body{.spring = 1.4}, method, end))) < 1e-12) == exact);
    };
    check_body(Rkmk4{.step = 0.1}, true);
    check_body(GaussLie4{.step = 0.1}, true, 1000);
    check_body(CrouchGrossman3{.step = 0.1}, true, 1000);
    check_body(Rk4{.step = 0.1}, false);
}

TEST_CASE("Lie-Poisson steps are Poisson maps with a bounded energy error, steps of Runge-Kutta type are not",
          "[group]")
{
    const auto defect = [](const auto& method) {
        const Top::State s = Top::start();
        const auto to = [&](const Top::State& from) {
            return Top::State(integrate(Top{}, from, {0.0, 0.2}, method).state);
        };
        Eigen::Matrix<double, 6, 6> D;
        const double d = 1e-3;
        for (int k = 0; k < 6; ++k) {
            const Top::State e = Top::State::Unit(k);
            D.col(k) = (8 * (to(s + d * e) - to(s - d * e)) - (to(s + 2 * d * e) - to(s - 2 * d * e))) / (12 * d);
        }
        return (D * Top::bracket(s) * D.transpose() - Top::bracket(to(s))).norm();
    };
    CHECK(defect(LiePoisson2{.step = 0.2}) < 1e-10);
    CHECK(defect(LiePoisson4{.step = 0.2}) < 1e-10);
    CHECK(defect(Rkmk4{.step = 0.2}) > 1e-6);
    const auto energy_error = [](const auto& method, double end) {
        double worst = 0;
        const auto run = integrate(Top{}, Top::start(), {0.0, end}, method, {}, [&](double, const Top::State& s) {
            worst = std::max(worst, std::abs(Top::energy(s) - Top::energy(Top::start())));
        });
        REQUIRE(run);
        return worst;
    };
    CHECK(energy_error(LiePoisson4{.step = 0.1}, 2000) < 4 * energy_error(LiePoisson4{.step = 0.1}, 100));
    CHECK(energy_error(Rkmk4{.step = 0.1}, 2000) > 10 * energy_error(Rkmk4{.step = 0.1}, 100));
}
