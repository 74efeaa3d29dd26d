// SPDX-License-Identifier: GPL-2.0-or-later
/// Powers of which lengths of steps are made.
#include "lagen/integrate/control.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <limits>

using namespace lagen;

TEST_CASE("Powers for lengths of steps are near those of the library, and grow with the number")
{
    for (const double y : {0.04, 1.0 / 8, 0.17, 1.0 / 5, 0.5, 1.0}) {
        double last = 0;
        for (double x = 1e-30; x < 1e30; x *= 1.00037) {
            const double power = detail::step_power(x, y);
            REQUIRE(std::abs(power / std::pow(x, y) - 1) < 6e-5 * (1 + y));
            REQUIRE(power >= last);
            last = power;
        }
        // Also where one piece of the series ends and the next one begins.
        for (int n = -30; n <= 30; ++n)
            for (const double x :
                 {std::exp2(n + 0.5), std::exp2((n % 5 + 0.5) / y), std::exp2(n % 5 / y), std::exp2(n)})
                REQUIRE(detail::step_power(x * (1 - 1e-12), y) <= detail::step_power(x * (1 + 1e-12), y));
        CHECK(detail::step_power(0.0, y) >= 0);
        CHECK(detail::step_power(0.0, y) < detail::step_power(1e-300, y));
        CHECK(detail::step_power(1.0, y) == 1);
        CHECK(detail::step_power(0.25F, static_cast<float>(y)) ==
              Approx(std::pow(0.25F, static_cast<float>(y))).epsilon(1e-4));
        CHECK(detail::step_power(0.25L, static_cast<long double>(y)) == std::pow(0.25L, static_cast<long double>(y)));
    }
    CHECK(detail::step_power(1e-12, 0.0) == 1);
}

TEMPLATE_TEST_CASE("A lane of a pack gets the power of its scalar", "", float, double)
{
    using P = Pack<TestType, 8>;
    TestType x = TestType(1e-20);
    for (int k = 0; k < 4000; ++k) {
        P numbers, exponents;
        for (int lane = 0; lane < 8; ++lane) {
            numbers.set(lane, x);
            exponents.set(lane, TestType(0.04 + 0.02 * lane));
            x *= TestType(1.0023);
        }
        const P powers = detail::step_power(numbers, exponents);
        const detail::TwoPowers<P> both(numbers, exponents, P(TestType(0.04)));
        for (int lane = 0; lane < 8; ++lane) {
            REQUIRE(powers[lane] == detail::step_power(numbers[lane], exponents[lane]));
            const detail::TwoPowers<TestType> alone(numbers[lane], exponents[lane], TestType(0.04));
            REQUIRE(both.of_all[lane] == alone.of_all);
            REQUIRE(both.of_all[lane] == powers[lane]);
            REQUIRE(both.of_large[lane] == alone.of_large);
        }
    }
}

TEST_CASE("A power of a neighbour is no smaller but for its last two bits, and within 1.2e-4")
{
    for (const double y : {1.0, 0.5, 0.2, 0.125, 0.04}) {
        double x = 1e-6, least = 0, farthest = 0;
        for (int k = 0; k < 20000; ++k, x *= 1.00071) {
            const double here = detail::step_power(x, y), next = detail::step_power(std::nextafter(x, 1e9), y);
            least = std::fmin(least, next / here - 1);
            farthest = std::fmax(farthest, std::abs(here / std::pow(x, y) - 1));
        }
        INFO("y " << y);
        CHECK(least >= -4 * std::numeric_limits<double>::epsilon());
        CHECK(farthest < 1.2e-4);
    }
}

TEST_CASE("Two powers are one of the number and one of the number where it is not small")
{
    for (const double x : {0.0, 1e-9, 1e-4, 0.3, 7.0}) {
        const detail::TwoPowers<double> both(x, 0.2, 0.04);
        CHECK(both.of_all == detail::step_power(x, 0.2));
        CHECK(both.of_large == Approx(std::pow(std::fmax(x, 1e-4), 0.04)).epsilon(1e-4));
    }
}

TEST_CASE("A controller on a lane is that of its trajectory alone")
{
    using P = Pack<double, 4>;
    const std::array<StepControl, 4> controls{StepControl{}, StepControl{.beta = 0},
                                              StepControl{.safety = 0.8, .grow = 6},
                                              StepControl{.shrink = 0.5, .beta = 0.1}};
    detail::Controller<P> together(StepControl{}, 5, P(0.75));
    std::array<detail::Controller<double>, 4> alone{
        detail::Controller<double>(controls[0], 5, 0.75), detail::Controller<double>(controls[1], 8, 0.2),
        detail::Controller<double>(controls[2], 5, 0.75), detail::Controller<double>(controls[3], 7, 0.75)};
    for (int lane = 0; lane < 4; ++lane) {
        CHECK(alone[std::size_t(lane)].after_rejected(1, 2.0) < 1);
        together.set_lane(lane, alone[std::size_t(lane)]);
    }
    const Mask<double, 4> everywhere = P(0) <= P(0);
    for (const double error : {0.9, 1e-7, 0.0, 0.5, 0.02}) {
        P errors(error);
        for (int lane = 0; lane < 4; ++lane) errors.set(lane, error * (1 - 0.1 * lane));
        const auto powers = together.powers(errors);
        const P next = together.length_after(P(0.25), powers);
        together.accept(everywhere, powers);
        for (int lane = 0; lane < 4; ++lane)
            CHECK(next[lane] == alone[std::size_t(lane)].after_accepted(0.25, errors[lane]));
    }
}
