// SPDX-License-Identifier: GPL-2.0-or-later
/// lagen::ode<N>: models of a user's own lambda.
#include "lagen/integrate.hpp"
#include "lagen/lanes/pack.hpp"
#include "runtime/pendulum.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

TEST_CASE("A lambda is a model: the same run as the model written out, forwards and backwards")
{
    const auto pendulum = ode<2>([](double, const auto& s, auto& ds) {
        ds[0] = s[1];
        ds[1] = -std::sin(s[0]);
    });
    const Eigen::Vector2d start(1, 0);
    const auto check = [&](const auto& method) {
        for (const double end : {2.0, -2.0}) {
            const auto run = integrate(pendulum, start, {0.0, end}, method);
            const auto written = integrate(problems::Pendulum<double>{}, start, {0.0, end}, method);
            CHECK(run.status() == Status::ok);
            CHECK(run.state == written.state);
            CHECK(run.rhs_calls == written.rhs_calls);
        }
    };
    check(Euler{.step = 0.01});
    check(Rk4{.step = 0.01});
    check(Dopri5{});
    check(Dop853{});
}

TEST_CASE("A lambda captures parameters and answers a status")
{
    double rate = 2, limit = 0.5;
    const auto decay = ode<1>([=](double t, const auto& s, auto& ds) {
        ds[0] = -rate * s[0];
        return t > limit ? Status::singular_mass_matrix : Status::ok;
    });
    rate = 0; // a copy was taken
    const auto run = integrate(decay, Eigen::Matrix<double, 1, 1>(1.0), {0.0, 1.0}, Rk4{.step = 0.125});
    CHECK(run.status() == Status::singular_mass_matrix);
    CHECK(run.t == 0.5);
    CHECK_THAT(run.state[0], Catch::WithinAbs(std::exp(-1.0), 1e-4));
    CHECK(integrate(decay, Eigen::Matrix<double, 1, 1>(1.0), {0.0, 0.25}, Dop853{}).status() == Status::ok);
    double live = 1; // captured by reference, it may change between runs
    const auto growth = ode<1>([&live](double, const auto& s, auto& ds) { ds[0] = live * s[0]; });
    const auto end = [&] {
        return integrate(growth, Eigen::Matrix<double, 1, 1>(1.0), {0.0, 1.0}, Dop853{.tolerance = 1e-12}).state[0];
    };
    CHECK_THAT(end(), Catch::WithinAbs(std::exp(1.0), 1e-10));
    live = -1;
    CHECK_THAT(end(), Catch::WithinAbs(std::exp(-1.0), 1e-10));
}

TEST_CASE("A generic lambda serves every scalar, packs included")
{
    const auto f = [](const auto& t, const auto& s, auto& ds) {
        ds[0] = s[1] + t;
        ds[1] = -s[0];
    };
    // x = sin t + cos t - 1 .. of x' = v + t, v' = -x: x'' = -x + 1 with x(0) = 0, v(0) = 1: x = 1 - cos t + sin t.
    const auto error = []<class S>(const S& x) {
        return std::abs(static_cast<long double>(x) - (1 - std::cos(1.0L) + std::sin(1.0L)));
    };
    const auto of = [&]<class S>(S) {
        using Column = Eigen::Matrix<S, 2, 1>;
        return integrate(ode<2, S>(f), Column(S(0), S(1)), {S(0), S(1)}, Rk4{.step = 1.0 / 64}).state[0];
    };
    CHECK(error(of(0.0)) < 1e-9L);
    CHECK(error(of(0.0f)) < 1e-5L);
    CHECK(error(of(0.0L)) < 1e-9L);
    using Lanes = Pack<double, 2>;
    const Eigen::Matrix<Lanes, 2, 1> start(Lanes(0.0), Lanes(std::array<double, 2>{1.0, 2.0}));
    const auto run = integrate(ode<2, Lanes>(f), start, {0.0, 1.0}, Rk4{.step = 1.0 / 64});
    CHECK(run.status() == Status::ok);
    CHECK(run.state[0][0] == of(0.0));
    CHECK(run.state[0][1] - run.state[0][0] > 0.5);
}

TEST_CASE("A lambda of accelerations is a model of second order, which knows whether they depend on rates")
{
    const auto pendulum = second_order_ode<1>([](double, const auto& x, auto& a) { a[0] = -std::sin(x[0]); });
    const auto damped =
        second_order_ode<1>([](double, const auto& x, const auto& v, auto& a) { a[0] = -std::sin(x[0]) - 0.1 * v[0]; });
    static_assert(second_order<decltype(pendulum)> == SecondOrder::velocity_free);
    static_assert(second_order<decltype(damped)> == SecondOrder::general);
    static_assert(second_order<problems::Pendulum<double>> == SecondOrder::no);
    const Eigen::Vector2d start(1, 0);
    const auto reference = integrate(problems::Pendulum<double>{}, start, {0, 5}, Dop853{.tolerance = 1e-14});
    const auto same = integrate(pendulum, start, {0, 5}, Dop853{.tolerance = 1e-14});
    CHECK(same.state == reference.state);
    const auto check = [&](const auto& model, const auto& method, const auto& exact) {
        for (const double back : {0.0, 5.0}) { // forwards, and backwards to the start
            const Eigen::Vector2d from = back == 0 ? start : Eigen::Vector2d(exact.state);
            const auto run = integrate(model, from, {back, 5 - back}, method);
            CHECK(run.status() == Status::ok);
            CHECK((run.state - (back == 0 ? Eigen::Vector2d(exact.state) : start)).norm() < 1e-10);
        }
    };
    check(pendulum, Rkn64{.tolerance = 1e-12}, reference);
    check(pendulum, Rkn86{.tolerance = 1e-12}, reference);
    check(pendulum, Rkn1210{.tolerance = 1e-12}, reference);
    check(pendulum, Rkng54{.tolerance = 1e-12}, reference);
    check(damped, Rkng54{.tolerance = 1e-12}, integrate(damped, start, {0, 5}, Dop853{.tolerance = 1e-14}));
}

TEST_CASE("An odd number of positions, and many, move as few do")
{
    const auto chain = second_order_ode<21>([](double t, const auto& x, auto& a) {
        for (Eigen::Index i = 0; i < 21; ++i)
            a[i] = (i > 0 ? x[i - 1] : std::sin(t)) - 2 * x[i] + (i < 20 ? x[i + 1] : 0) - x[i] * x[i] * x[i];
    });
    const Eigen::Matrix<double, 42, 1> start = Eigen::Matrix<double, 42, 1>::LinSpaced(-0.5, 0.7);
    const std::array<double, 4> at{0.31, 1.7, 2.9, 4};
    const auto reference = integrate(chain, start, {0, 4}, Dop853{.tolerance = 1e-14}, {.at = at});
    const auto check = [&](const auto& method) {
        const auto run = integrate(chain, start, {0, 4}, method, {.at = at});
        REQUIRE(run.status() == Status::ok);
        REQUIRE(run.states.size() == at.size());
        for (std::size_t k = 0; k < at.size(); ++k) CHECK((run.states[k] - reference.states[k]).norm() < 1e-10);
    };
    check(Rkn64{.tolerance = 1e-12});
    check(Rkn86{.tolerance = 1e-12});
    check(Rkn1210{.tolerance = 1e-12});
    check(Rkng54{.tolerance = 1e-12});
    check(Verner65{.tolerance = 1e-12});
    check(Verner76{.tolerance = 1e-12});
    check(Verner87{.tolerance = 1e-12});
    check(Verner98{.tolerance = 1e-12});
}
