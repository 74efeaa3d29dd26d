// SPDX-License-Identifier: GPL-2.0-or-later
/// Measured orders of every integrator and of every dense output on nonlinear problems, in long double.
#include "lagen/lagen.hpp"
#include "support/order.hpp"
#include "support/problems.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using Real = long double;
using Kepler = lagen::problems::Kepler<Real>;
using lagen::support::measured_order;

namespace {

/// The method with steps of exactly h.
template <class Method>
Method with_step(double h)
{
    if constexpr (requires(Method m) { m.step; })
        return Method{.step = h};
    else
        return Method{.tolerance = 1e12, .first_step = h, .max_step = h};
}

/// Kepler e = 0.3 from t = 0.5 to 4.5 against the closed form.
template <class Method>
double global_order(int coarsest)
{
    std::vector<lagen::support::ErrorPoint> points;
    for (int k = 0; k < 5; ++k) {
        const double h = 4.0 / (coarsest << k);
        const auto run = lagen::integrate(Kepler{}, Kepler::exact(0.3L, 0.5L), {0.5L, 4.5L}, with_step<Method>(h));
        REQUIRE(run.status() == lagen::Status::ok);
        CHECK(run.steps == static_cast<std::size_t>(coarsest << k));
        points.push_back({h, (run.state - Kepler::exact(0.3L, 4.5L)).norm()});
    }
    return measured_order(points, 1e-16L);
}

/// The free rigid body over one period, after which it is back (known to 21 digits).
template <class Method>
double period_order(int coarsest)
{
    using Body = lagen::problems::RigidBody<Real>;
    const Real period = 10.7314652348828038338L;
    const Body::State start(std::cos(1.1L), 0, std::sin(1.1L));
    std::vector<lagen::support::ErrorPoint> points;
    for (int k = 0; k < 4; ++k) {
        const double h = static_cast<double>(period) / (coarsest << k);
        const auto run = lagen::integrate(Body{}, start, {0, period}, with_step<Method>(h));
        REQUIRE(run.status() == lagen::Status::ok);
        points.push_back({h, (run.state - start).norm()});
    }
    return measured_order(points, 1e-17L);
}

/// One step; the worst error at three points inside it, which is of order dense_order + 1.
template <class Method>
double dense_order(double coarsest)
{
    std::vector<lagen::support::ErrorPoint> points;
    for (int k = 0; k < 5; ++k) {
        const double h = coarsest / (1 << k);
        const std::array<Real, 3> at{0.5L + 0.21L * h, 0.5L + 0.52L * h, 0.5L + 0.83L * h};
        const auto run =
            lagen::integrate(Kepler{}, Kepler::exact(0.3L, 0.5L), {0.5L, 0.5L + h}, with_step<Method>(h), {.at = at});
        REQUIRE(run.steps == 1);
        REQUIRE(run.states.size() == 3);
        Real worst = 0;
        for (std::size_t i = 0; i < 3; ++i)
            worst = std::max(worst, (run.states[i] - Kepler::exact(0.3L, at[i])).norm());
        points.push_back({h, worst});
    }
    return measured_order(points, 2e-18L) - 1;
}

auto near(double order)
{
    return Catch::WithinAbs(order, lagen::tolerance::order);
}

} // namespace

#define CHECK_ORDERS(Method, order, dense, steps, step)                                                                \
    CHECK_THAT(global_order<lagen::Method>(steps), near(order));                                                       \
    CHECK_THAT(dense_order<lagen::Method>(step), near(dense))

TEST_CASE("Fixed-step Runge-Kutta methods converge with their order, inside steps too")
{
    CHECK_ORDERS(Euler, 1, 1, 4096, 0.1);
    CHECK_ORDERS(Midpoint, 2, 2, 256, 0.1);
    CHECK_ORDERS(Heun, 2, 2, 256, 0.1);
    CHECK_ORDERS(Ralston, 2, 2, 256, 0.1);
    CHECK_ORDERS(Kutta3, 3, 3, 128, 0.1);
    CHECK_ORDERS(Rk4, 4, 4, 64, 0.1);
    CHECK_ORDERS(Rk38, 4, 4, 64, 0.1);
}

TEST_CASE("Adaptive methods held to one step size converge with their order, their dense output with its own")
{
    CHECK_ORDERS(Dopri5, 5, 4, 256, 0.2);
    CHECK_ORDERS(Tsit5, 5, 4, 256, 0.2);
    CHECK_ORDERS(Dop853, 8, 7, 16, 0.4);
}

TEST_CASE("Splitting methods converge with their order, inside steps too")
{
    CHECK_ORDERS(LeapfrogDkd, 2, 2, 256, 0.1);
    CHECK_ORDERS(LeapfrogKdk, 2, 2, 256, 0.1);
    CHECK_ORDERS(McLachlan4, 4, 4, 64, 0.1);
    CHECK_ORDERS(Yoshida6, 6, 6, 64, 0.2);
}

TEST_CASE("Gauss' methods converge with twice the number of their stages, Radau IIA with 3 and 5, inside steps too")
{
    CHECK_ORDERS(Gauss2, 2, 2, 128, 0.2);
    CHECK_ORDERS(Gauss4, 4, 4, 32, 0.4);
    CHECK_ORDERS(Gauss6, 6, 6, 16, 0.8);
    CHECK_ORDERS(Gauss8, 8, 8, 8, 0.2);
    CHECK_ORDERS(Radau3Fixed, 3, 3, 64, 0.2);
    CHECK_ORDERS(Radau5Fixed, 5, 5, 32, 0.4);
    CHECK_THAT(period_order<lagen::Gauss2>(128), near(2));
    CHECK_THAT(period_order<lagen::Gauss4>(64), near(4));
    CHECK_THAT(period_order<lagen::Gauss6>(32), near(6));
    CHECK_THAT(period_order<lagen::Gauss8>(32), near(8));
    CHECK_THAT(period_order<lagen::Radau3Fixed>(128), near(3));
    CHECK_THAT(period_order<lagen::Radau5Fixed>(64), near(5));
}
