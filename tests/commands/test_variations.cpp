// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run --variations` and `--jacobi-field`: computed motions are critical points of the action, and Jacobi fields
/// are those of spaces of constant curvature.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

json::Value action_of(std::vector<std::string> arguments)
{
    return report_of("run", std::move(arguments))["action"];
}

} // namespace

TEST_CASE("motions are critical points of the action, and those of a coarse method are not", "[run]")
{
    const json::Value exact = action_of({"heavy_top.toml", "--variations", "4", "--tolerance", "1e-13"});
    CHECK(exact["parts"].number() > 1);
    CHECK(exact["first"].number() < 1e-12 * exact["parts"].number());
    CHECK(exact["second"].entries.size() == 4);
    const json::Value coarse = action_of({"heavy_top.toml", "--variations", "4", "--method", "rk4", "--step", "0.2"});
    CHECK(coarse["first"].number() > 1e-6 * coarse["parts"].number());
    const json::Value others =
        action_of({"heavy_top.toml", "--variations", "4", "--seed", "7", "--tolerance", "1e-13"});
    CHECK(others["first"].number() < 1e-12 * others["parts"].number());
    CHECK(others["second"].entries[0].number() != exact["second"].entries[0].number());
    CHECK(others["value"].number() == Approx(exact["value"].number()).epsilon(1e-12));
}

TEST_CASE("where L does not depend on x a first variation is told from its terms, which cancel alone too", "[run]")
{
    for (const char* model : {"rigid_body.toml", "half_plane.toml"}) {
        const json::Value action = action_of({model, "--variations", "2", "--tolerance", "1e-13"});
        INFO(model);
        CHECK(action["parts"].number() > 1);
        CHECK(action["first"].number() < 1e-12 * action["parts"].number());
        for (const json::Value& base : action["base"].entries) CHECK(base.number() == 0);
        const json::Value coarse = action_of({model, "--variations", "2", "--method", "rk4", "--step", "0.5"});
        CHECK(coarse["parts"].number() == Approx(action["parts"].number()).epsilon(0.05));
    }
}

TEST_CASE("the terms of a first variation bound what its parts come to", "[run]")
{
    // A part has 2 r terms at most: by Schwarz's inequality it is at most sqrt(2 r) = 2.4.. times the bound.
    const json::Value action = action_of({"heavy_top.toml", "--variations", "3"});
    for (const char* part : {"base", "fibre"})
        for (const json::Value& value : action[part].entries)
            CHECK(std::abs(value.number()) < 3 * action["parts"].number());
}

TEST_CASE("the second variation of a short motion is positive, and that beyond a conjugate point is not always",
          "[run]")
{
    const std::string path =
        written_file("oscillator.toml",
                     "[base]\ncoordinates = [\"q\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"(v_q^2 - "
                     "q^2)/2\"\n[scene.default]\ninitial = { q = 1, v_q = 0 }\nduration = 3\n");
    const auto least = [&](const char* end) {
        long double value = INFINITY;
        const json::Value action = action_of({path, "--variations", "40", "--t-end", end});
        for (const json::Value& each : action["second"].entries) value = std::min(value, each.number());
        return value;
    };
    CHECK(least("3.1") > 0); // before pi
    CHECK(least("4") < 0);
}

TEST_CASE("Jacobi fields of constant curvature are sines and hyperbolic sines", "[run]")
{
    const std::string path = written_file(
        "sphere.toml",
        "[base]\ncoordinates = [\"th\", \"ph\"]\ndomain = [\"sin(th) > 0\"]\n[fibre]\ncoordinates = [\"w\", "
        "\"v\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"(w^2 + sin(th)^2*v^2)/2\"\n"
        "[scene.default]\ninitial = { th = \"pi/2\", ph = 0, w = 0, v = 1 }\nduration = \"pi\"\n"
        "observe = [\"th\"]\n");
    for (const double end : {1.0, std::numbers::pi / 2, std::numbers::pi}) {
        const std::vector<double> row =
            last_row({path, "--jacobi-field", "w=1", "--tolerance", "1e-13", "--t-end", std::to_string(end)});
        CHECK(row[2] == Approx(std::sin(row[0])).margin(1e-11)); // sigma.w; 0 at the conjugate point
        CHECK(row[4] == Approx(std::cos(row[0])).margin(1e-11)); // delta.w
    }
    // On the half-plane the normal part is sinh(c t)/c of that at the start, c the speed.
    const std::vector<double> row =
        last_row({"half_plane.toml", "--jacobi-field", "a=1", "--tolerance", "1e-13", "--t-end", "5"});
    const double a0 = 0.7, b0 = 1.1, c = std::sqrt(a0 * a0 + b0 * b0);
    const double normal = (-row[4] * row[5] + row[3] * row[6]) / c;
    CHECK(normal == Approx(-b0 / c * std::sinh(5 * c) / c).epsilon(1e-9));
}
