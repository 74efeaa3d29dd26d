// SPDX-License-Identifier: GPL-2.0-or-later
/// The 113 bits in which `lagen chart` makes its references.
#include "lagen_chart/quad.hpp"

#include "rigid_body.hpp"

#include "lagen/integrate.hpp"
#include "lagen_chart/points.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

namespace {

using lagen::Quad;

/// A decimal fraction to the last bits.
Quad decimal(const std::string& text)
{
    Quad value = 0, unit = 1;
    bool behind = false;
    for (const char c : text) {
        if (c == '.') behind = true;
        if (c < '0' || c > '9') continue;
        value = value * 10 + Quad(c - '0');
        if (behind) unit *= 10;
    }
    return (text[0] == '-' ? -value : value) / unit;
}

double distance(Quad x, Quad y)
{
    return static_cast<double>(abs(x - y));
}

} // namespace

TEST_CASE("functions of 113 bits are those of a scalar")
{
    constexpr double rounding = 1e-32;
    const Quad x = Quad(3) / 7;
    CHECK(distance(sqrt(x) * sqrt(x), x) < rounding);
    CHECK(distance(cbrt(x) * cbrt(x) * cbrt(x), x) < rounding);
    CHECK(distance(exp(log(x)), x) < rounding);
    CHECK(distance(sin(asin(x)), x) < rounding);
    CHECK(distance(cos(acos(x)), x) < rounding);
    CHECK(distance(tan(atan(x)), x) < rounding);
    CHECK(distance(atan2(x, Quad(1)), atan(x)) < rounding);
    CHECK(distance(tanh(x) * cosh(x), sinh(x)) < rounding);
    CHECK(distance(pow(x, Quad(3)), x * x * x) < rounding);
    CHECK(distance(erf(-x), -erf(x)) < rounding);
    CHECK(distance(4 * atan(Quad(1)), lagen::arithmetic::pi<Quad>()) < rounding);
    CHECK(static_cast<double>(x) == 3.0 / 7);
    const Quad epsilon = std::numeric_limits<Quad>::epsilon();
    CHECK(Quad(1) + epsilon != Quad(1));
    CHECK(Quad(1) + epsilon / 2 == Quad(1));
}

TEST_CASE("pairs in 113 bits follow a rigid body to the digits that their tolerance asks for")
{
    const lagen::json::Value exact =
        lagen::json::read_file(LAGEN_SOURCE_DIR "/tests/data/continuous/rigid_body_near_axis1.json");
    using Body = lagen::models::rigid_body<Quad>;
    Body body;
    body.parameters.I1 = decimal("1.1");
    body.parameters.I2 = decimal("2.3");
    body.parameters.I3 = decimal("3.4");
    Body::State start;
    for (int i = 0; i < 3; ++i) start[i] = decimal(exact["initial_state"][static_cast<std::size_t>(i)].text);
    const auto ends_there = [&](const auto& method, double error) {
        const auto run = lagen::integrate(body, start, {Quad(0), Quad(20)}, method);
        REQUIRE(run);
        for (int i = 0; i < 3; ++i) {
            const Quad wanted = decimal(exact["final_state"][static_cast<std::size_t>(i)].text);
            CHECK(distance(run.state[i], wanted) < error);
            CHECK(distance(run.state[i], wanted) > 0);
        }
    };
    ends_there(lagen::Verner98{.tolerance = 1e-21}, 1e-19);
    ends_there(lagen::Verner87{.tolerance = 1e-21}, 1e-19);
    ends_there(lagen::Dop853{.tolerance = 1e-23}, 1e-21); // 20 digits of a coefficient lead to 1e-19
}

TEST_CASE("the error of rows is the largest distance relative to the whole state")
{
    using State = Eigen::Vector2d;
    const std::vector<State> rows{{3, 4.5}, {0, 1}, {0.25, 0}};
    CHECK(lagen::chart::error_of(rows, {3, 0, 4, 0, 0, 0, 1, 0, 0.25, 0, 0, 0}) == 0.1);
    // a reference of two doubles tells rows apart that are the same double
    CHECK(lagen::chart::error_of<State>({{1, 0}}, {1, 0x1p-60, 0, 0}) == 0x1p-60);
    CHECK(lagen::chart::error_of<State>({{0, 0.5}}, {0, 0, 0, 0}) == 0.5);
    CHECK(std::isnan(lagen::chart::error_of<State>({{std::nan(""), 0}}, {1, 0, 0, 0})));
}
