// SPDX-License-Identifier: GPL-2.0-or-later
/// Measured orders of every integrator and of every dense output on nonlinear problems, in long double; of those of the
/// highest orders in quadruple precision.
#include "lagen/lagen.hpp"
#include "lagen_chart/quad.hpp"
#include "support/order.hpp"
#include "support/problems.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using Real = long double;
using lagen::Quad;

// Two orders show in 50 digits alone, which take the compiler and the processor several times as long.
#ifdef LAGEN_ALL_TESTS
#include <boost/multiprecision/cpp_bin_float.hpp>
using Fifty = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
#endif

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

/// Kepler e = 0.3 as a system of second order.
template <class S>
struct Kepler : lagen::problems::Kepler<S> {
    static constexpr auto second_order = lagen::SecondOrder::velocity_free;
    static auto at(const S& t) { return Kepler::exact(S(0.3), t); }
};

/// |a - b| of two states.
template <class State>
long double distance(const State& a, const State& b)
{
    return static_cast<long double>((a - b).norm());
}

/// From t = 0.5 to 4.5 against the closed form.
template <class Method, class S = Real>
double global_order(int coarsest, long double floor = 1e-16L)
{
    std::vector<lagen::support::ErrorPoint> points;
    for (int k = 0; k < 5; ++k) {
        const double h = 4.0 / (coarsest << k);
        const auto run = lagen::integrate(Kepler<S>{}, Kepler<S>::at(S(0.5)), {S(0.5), S(4.5)}, with_step<Method>(h));
        REQUIRE(run.status() == lagen::Status::ok);
        CHECK(run.steps == static_cast<std::size_t>(coarsest << k));
        points.push_back({h, distance(run.state, Kepler<S>::at(S(4.5)))});
    }
    return measured_order(points, floor);
}

/// A pendulum with damping and a drive, x'' = -sin x - 0.3 x' + cos(2 t) / 2, against steps of an eighth of the
/// smallest.
template <class Method, class S = Real>
double driven_order(int coarsest, long double floor = 1e-16L)
{
    const auto pendulum = lagen::second_order_ode<1, S>([](S t, const auto& x, const auto& v, auto& a) {
        using std::cos;
        using std::sin;
        a[0] = -sin(x[0]) - S(0.3) * v[0] + cos(S(2) * t) / S(2);
    });
    const auto end = [&](int steps) {
        const auto run = lagen::integrate(pendulum, {S(1), S(0.5)}, {S(0), S(4)}, with_step<Method>(4.0 / steps));
        REQUIRE(run.status() == lagen::Status::ok);
        return run.state;
    };
    const auto exact = end(coarsest << 6);
    std::vector<lagen::support::ErrorPoint> points;
    for (int k = 0; k < 5; ++k) points.push_back({4.0L / (coarsest << k), distance(end(coarsest << k), exact)});
    return measured_order(points, floor);
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
template <class Method, class S = Real>
double dense_order(double coarsest, long double floor = 2e-18L)
{
    std::vector<lagen::support::ErrorPoint> points;
    for (int k = 0; k < 5; ++k) {
        const double h = coarsest / (1 << k);
        const S start = S(0.5);
        const std::array<S, 3> at{start + S(0.21 * h), start + S(0.52 * h), start + S(0.83 * h)};
        const auto run = lagen::integrate(Kepler<S>{}, Kepler<S>::at(S(0.5)), {S(0.5), start + S(h)},
                                          with_step<Method>(h), {.at = at});
        REQUIRE(run.steps == 1);
        REQUIRE(run.states.size() == 3);
        Real worst = 0;
        for (std::size_t i = 0; i < 3; ++i) worst = std::max(worst, distance(run.states[i], Kepler<S>::at(at[i])));
        points.push_back({h, worst});
    }
    return measured_order(points, floor) - 1;
}

#ifdef LAGEN_ALL_TESTS
/// One step; the error at its end, which is of one order more.
template <class Method, class S>
double local_order(double coarsest, long double floor)
{
    std::vector<lagen::support::ErrorPoint> points;
    for (int k = 0; k < 5; ++k) {
        const double h = coarsest / (1 << k);
        const S start = S(0.5), end = start + S(h);
        const auto run = lagen::integrate(Kepler<S>{}, Kepler<S>::at(start), {start, end}, with_step<Method>(h));
        REQUIRE(run.steps == 1);
        points.push_back({h, distance(run.state, Kepler<S>::at(end))});
    }
    return measured_order(points, floor) - 1;
}
#endif

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

/// Of orders that a long double shows too little of.
#define CHECK_WIDE_ORDERS(Method, order, dense, steps, step)                                                           \
    CHECK_THAT((global_order<lagen::Method, Quad>(steps, 1e-29L)), near(order));                                       \
    CHECK_THAT((dense_order<lagen::Method, Quad>(step, 1e-30L)), near(dense))

TEST_CASE("Verner's pairs converge with their order, their interpolants with one less")
{
#ifdef LAGEN_ALL_TESTS
    // Its leading error is so small that it leads in short steps alone.
    CHECK_THAT((local_order<lagen::Verner65, Fifty>(0.001, 1e-38L)), near(6));
#endif
    CHECK_THAT((dense_order<lagen::Verner65, Quad>(0.1, 1e-30L)), near(5));
    CHECK_WIDE_ORDERS(Verner76, 7, 6, 64, 0.2);
    CHECK_WIDE_ORDERS(Verner87, 8, 7, 32, 0.2);
    CHECK_WIDE_ORDERS(Verner98, 9, 8, 32, 0.1);
    CHECK_THAT((driven_order<lagen::Verner76, Quad>(32, 1e-28L)), near(7));
    CHECK_THAT((driven_order<lagen::Verner87, Quad>(64, 1e-28L)), near(8));
}

TEST_CASE("Nystrom's pairs converge with their order, inside steps too")
{
    CHECK_WIDE_ORDERS(Rkn64, 6, 5, 64, 0.2);
    CHECK_WIDE_ORDERS(Rkn86, 8, 7, 32, 0.2);
    CHECK_WIDE_ORDERS(Rkn1210, 12, 10, 16, 0.2);
    CHECK_WIDE_ORDERS(Rkng54, 5, 4, 128, 0.2);
    CHECK_THAT((driven_order<lagen::Rkng54, Quad>(256, 1e-28L)), near(5));
}

TEST_CASE("Splitting methods converge with their order, inside steps too")
{
    CHECK_ORDERS(LeapfrogDkd, 2, 2, 256, 0.1);
    CHECK_ORDERS(LeapfrogKdk, 2, 2, 256, 0.1);
    CHECK_ORDERS(McLachlan4, 4, 4, 64, 0.1);
    CHECK_ORDERS(BlanesMoan4, 4, 4, 32, 0.1);
    CHECK_ORDERS(Srkn4, 4, 4, 256, 0.1);
    CHECK_ORDERS(Yoshida6, 6, 6, 64, 0.2);
    CHECK_ORDERS(BlanesMoan6, 6, 6, 32, 0.2);
    CHECK_ORDERS(Srkn6, 6, 6, 16, 0.4);
    CHECK_WIDE_ORDERS(KahanLi8, 8, 8, 32, 0.2);
    CHECK_WIDE_ORDERS(Sofroniou10, 10, 10, 16, 0.2);
}

TEST_CASE("Gauss' methods converge with twice the number of their stages, Radau IIA with 3 and 5, inside steps too")
{
    CHECK_ORDERS(Gauss2, 2, 2, 128, 0.2);
    CHECK_ORDERS(Gauss4, 4, 4, 32, 0.4);
    CHECK_ORDERS(Gauss6, 6, 6, 16, 0.8);
    CHECK_ORDERS(Gauss8, 8, 8, 8, 0.2);
    CHECK_WIDE_ORDERS(Gauss12, 12, 12, 8, 0.4);
    CHECK_THAT((global_order<lagen::Gauss16, Quad>(16, 1e-29L)), near(16));
#ifdef LAGEN_ALL_TESTS
    CHECK_THAT((dense_order<lagen::Gauss16, Fifty>(0.1, 1e-42L)), near(16));
#endif
    CHECK_ORDERS(Radau3Fixed, 3, 3, 64, 0.2);
    CHECK_ORDERS(Radau5Fixed, 5, 5, 32, 0.4);
    CHECK_THAT(period_order<lagen::Gauss2>(128), near(2));
    CHECK_THAT(period_order<lagen::Gauss4>(64), near(4));
    CHECK_THAT(period_order<lagen::Gauss6>(32), near(6));
    CHECK_THAT(period_order<lagen::Gauss8>(32), near(8));
    CHECK_THAT(period_order<lagen::Radau3Fixed>(128), near(3));
    CHECK_THAT(period_order<lagen::Radau5Fixed>(64), near(5));
}
