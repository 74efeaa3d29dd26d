// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor's method over long times: rounding errors without a bias, exact times, any unit of time.
#include "runtime/taylor_models.hpp"
#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace lagen;
using namespace lagen::testing;

TEST_CASE("compensated sums keep an invariant to round-off over a long run")
{
    const Prey<double> model;
    const auto invariant = [](const Eigen::Vector2d& s) { return std::log(s[0] * s[1]) - s[0] - s[1]; };
    const Eigen::Vector2d s(2, 0.5);
    double drift = 0;
    Integrator integrator(model, s, 0.0, Taylor{.tolerance = 1e-16});
    while (integrator.t() < 3000) {
        REQUIRE(integrator.step() == Status::ok);
        drift = std::max(drift, std::abs(invariant(integrator.state()) - invariant(s)));
    }
    CHECK(drift < 1e-13);
    CHECK(drift > 0);
}

TEST_CASE("a part of a number is rounded without a bias, in a unit that is a power of two")
{
    const auto check = []<class S>(S) {
        std::mt19937 random(3);
        std::uniform_real_distribution<S> number(1, 2);
        for (int k = 1; k < 70; ++k) {
            double bias = 0, largest = 0;
            constexpr int count = 4000;
            for (int n = 0; n < count; ++n) {
                const S x = number(random), found = OneOver<S>(k) * x;
                REQUIRE(OneOver<S>(k, S(0x1p-40)) * x == S(0x1p-40) * found);
                const long double exact = static_cast<long double>(x) / k;
                const double error = static_cast<double>((found - exact) / exact / std::numeric_limits<S>::epsilon());
                bias += error / count;
                largest = std::max(largest, std::abs(error));
            }
            INFO("1/" << k << " of " << sizeof(S) << " bytes");
            CHECK(std::abs(bias) < 0.03);
            CHECK(largest < 1);
        }
    };
    check(1.0F);
    check(1.0);
}

TEST_CASE("the constant of a rigid body walks at random for a million steps")
{
    constexpr std::size_t long_run = LAGEN_SANITIZED ? 10'000 : 1'000'000;
    const long double epsilon = std::numeric_limits<double>::epsilon();
    for (const double part : {0.0, 0.3, 0.6}) {
        const TurningBody::State start(0.6 + part, 1.1, 0.5 - part / 2);
        const long double begin = TurningBody::constant(start);
        Integrator integrator(TurningBody{}, start, 0.0, Taylor{.tolerance = 1e-16});
        for (std::size_t next = 1000; next <= long_run; next *= 10) {
            while (integrator.steps() < next) REQUIRE(integrator.step() == Status::ok);
            const long double error = std::abs(TurningBody::constant(integrator.state()) / begin - 1);
            INFO("after " << next << " steps " << static_cast<double>(error));
            CHECK(error < 0.7L * epsilon * std::sqrt(static_cast<long double>(next)));
        }
    }
}

TEST_CASE("the last step goes from the exact time to the end")
{
    const Ramp clock;
    Integrator integrator(clock, Ramp::State(-20.0), 1e6, Taylor{.tolerance = 1e-12, .max_step = 0.1});
    REQUIRE(integrator.advance_to(1e6 + 10) == Status::ok);
    CHECK(std::abs(integrator.state()[0] + 10) < 1e-14);
    Integrator fixed(clock, Ramp::State(-20.0), 1e6, Rk4{.step = 0.1});
    REQUIRE(fixed.advance_to(1e6 + 10.05) == Status::ok);
    CHECK(std::abs(fixed.state()[0] - (1e6 + 10.05 - 1e6 - 20)) < 1e-13);
}

TEST_CASE("the unit of time does not matter, though coefficients in it overflow or vanish")
{
    const Eigen::Vector2d s(2, 0.5);
    const Taylor method{.tolerance = 1e-14};
    const auto plain = integrate(Prey<double>{}, s, {0.0, 5.0}, method);
    REQUIRE(plain);
    for (const double unit : {0x1p-60, 0x1p60, 1e-13, 1e13}) {
        const auto run = integrate(Prey<double>{unit}, s, {0.0, 5 / unit}, method);
        INFO("unit " << unit);
        REQUIRE(run);
        CHECK(run.steps == plain.steps);
        CHECK((run.state - plain.state).norm() < 1e-13);
    }
}
