// SPDX-License-Identifier: GPL-2.0-or-later
/// Models with a Lagrangian on every kind of groupoid, run by schemes, and their errors against a curve.
#pragma once

#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <fstream>

namespace lagen::testing::schemes {

inline constexpr const char* curve_scene = R"toml(
[scene.curve]
form = "hamilton"
duration = 4
method = "dop853"
tolerance = 1e-14
)toml";

/// Parts of a model with a Lagrangian and a groupoid; `start` is the scenes' `initial`.
struct SchemeModel {
    const char* name;
    const char* text;
    const char* start;
};

inline constexpr SchemeModel pairs{"pendulum", R"toml(
[base]
coordinates = ["q"]
[groupoid]
kind = "pair"
[lagrangian]
L = "v_q^2/2 + cos(q)"
)toml",
                                   "{ q = 1.2, v_q = 0.4 }"};

inline constexpr SchemeModel top{"top", R"toml(
[base]
coordinates = ["G[1..3]"]
constraints = ["dot(G, G) - 1"]
[fibre]
coordinates = ["w1", "w2", "w3"]
[groupoid]
kind = "action"
group = "SO(3)"
action = { G = "transpose(W)*G" }
[lagrangian]
L = "(1.2*w1^2 + 2.1*w2^2 + 2.9*w3^2)/2 - 1.7*(0.48*G[1] + 0.6*G[2] + 0.64*G[3])"
)toml",
                                 "{ G = [0.6, 0, 0.8], w1 = 0.4, w2 = 0.9, w3 = -0.3 }"};

inline constexpr SchemeModel charged{"charged", R"toml(
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["u", "v", "w"]
[algebroid]
kind = "atiyah"
bracket = {}
connection = { x = { w = "-y/2 - x*y^2" }, y = { w = "x/2 + sin(x)" } }
[groupoid]
kind = "atiyah"
group = "SO(2)"
[lagrangian]
L = "1.3*(u^2 + v^2)/2 + w^2/2 + x*w/5 - x^2/2 - y^4/4"
)toml",
                                     "{ x = 0.5, y = 0.2, u = 0.4, v = 0.9, w = -0.3 }"};

inline constexpr SchemeModel driven{"driven", R"toml(
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["u", "v", "w"]
[algebroid]
kind = "atiyah"
bracket = {}
connection = { x = { w = "-y/2 - x*y^2" }, y = { w = "x/2 + sin(x)" } }
[groupoid]
kind = "atiyah"
group = "SO(2)"
[lagrangian]
L = "1.3*(u^2 + v^2)/2 + w^2/2 + x*w/5 - x^2/2 - y^4/4"
[forces]
u = "-0.3*u*x"
v = "w*x + sin(2*t)/5"
w = "-0.2*w + u*y"
)toml",
                                    "{ x = 0.5, y = 0.2, u = 0.4, v = 0.9, w = -0.3 }"};

inline long double entry(const lagen::json::Value& found, const std::string& column)
{
    for (std::size_t k = 0; k < found["columns"].size(); ++k)
        if (found["columns"][k].text == column) return std::stold(found["rows"][found["rows"].size() - 1][k].text);
    FAIL("no column " << column);
    return 0;
}

inline lagen::json::Value ran(const std::vector<std::string>& arguments)
{
    std::vector<std::string> all{"run"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.insert(all.end(), {"--format", "json"});
    const Outcome outcome = call(all);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return lagen::json::parse(outcome.out);
}

inline std::string scheme_file(const SchemeModel& model, const std::string& scheme, const std::string& retraction = "")
{
    std::string text =
        fmt::format("name = \"{}\"\n{}[discrete]\nstep = \"h\"\nscheme = \"{}\"\n", model.name, model.text, scheme);
    if (!retraction.empty()) text += fmt::format("retraction = \"{}\"\n", retraction);
    text += fmt::format("[scene.default]\nsteps = 1\ninitial = {}\n{}initial = {}\n", model.start, curve_scene,
                        model.start);
    const std::string path = fresh_folder() + "/" + model.name + ".toml";
    std::ofstream(path) << text;
    return path;
}

struct SchemeOrder {
    const char* scheme;
    double order;
    const char *coarse = "0.2", *fine = "0.1"; ///< steps; errors at order 8 are rounding below 0.2
};

/// The largest difference between the last rows of a curve and of what was found, over the curve's columns.
inline long double error_against(const lagen::json::Value& exact, const lagen::json::Value& found)
{
    long double most = 0;
    for (std::size_t k = 1; k < exact["columns"].size(); ++k) {
        const std::string column = exact["columns"][k].text;
        most = std::max(most, std::abs(entry(found, column) - entry(exact, column)));
    }
    return most;
}

/// The errors at t = 4 of two steps, and the order between them.
inline void require_orders(const SchemeModel& model, const std::vector<SchemeOrder>& schemes,
                           const std::string& retraction = "")
{
    const lagen::json::Value exact = ran({scheme_file(model, "midpoint", retraction), "--scene", "curve", "--at", "4"});
    for (const auto& [scheme, order, large, small] : schemes) {
        INFO(model.name << " by " << scheme);
        const std::string path = scheme_file(model, scheme, retraction);
        const auto error = [&](const char* step) {
            return error_against(exact, ran({path, "--t-end", "4", "--step", step}));
        };
        const long double coarse = error(large), fine = error(small);
        CHECK(coarse > 0);
        const auto found = static_cast<double>(std::log2(coarse / fine));
        CHECK(std::abs(found - order) < 0.25);
    }
}

} // namespace lagen::testing::schemes
