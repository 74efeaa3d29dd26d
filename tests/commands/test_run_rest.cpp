// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete motions whose arrows are small or lost in rounding: at rest, a slow coordinate beside a fast one, elements
/// so large that any momenta are theirs to rounding.
#include "scheme_models.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

struct Rest {
    json::Value value;
    std::string told;

    /// Of a lane, in the last row.
    [[nodiscard]] double last(std::size_t lane) const
    {
        return static_cast<double>(value["rows"][value["rows"].size() - 1][lane].number());
    }
};

Rest rest_of(const std::string& text, const std::vector<std::string>& more = {})
{
    const std::string folder = fresh_folder();
    write_text(folder + "/m.toml", text);
    std::vector<std::string> arguments{"run", "m.toml", "--format", "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = call(arguments, {.folder = folder});
    INFO(outcome.err);
    REQUIRE(outcome.code <= 1);
    return {json::parse(outcome.out), outcome.err};
}

/// A particle in a well, with friction; the motion ends where x^3 + 100 x = 300.
std::string well(const std::string& scheme)
{
    return fmt::format(R"toml(
[base]
coordinates = ["x"]
[fibre]
coordinates = ["u"]
[groupoid]
kind = "pair"
[lagrangian]
L = "u^2/2 - (x^4/4 - 300*x + 50*x^2)"
[dissipation]
R = "3*u^2"
[discrete]
step = "h"
scheme = "{}"
[scene.default]
initial = {{ x = 1, u = 0.5 }}
step = 0.1
steps = 400
)toml",
                       scheme);
}

} // namespace

TEST_CASE("a discrete motion that comes to rest stays there", "[run][all]")
{
    for (const char* scheme : {"midpoint", "gauss:2"}) {
        INFO(scheme);
        const Rest rest = rest_of(well(scheme));
        CHECK(rest.value["status"].text == "ok");
        const double x = rest.last(1);
        CHECK(std::abs(x * x * x + 100 * x - 300) < 1e-10);
    }
    const Rest top = rest_of(std::string(schemes::top.text) + R"toml(
[dissipation]
R = "w1^2 + w2^2 + w3^2"
[discrete]
step = "h"
scheme = "midpoint"
[scene.default]
initial = { G = [0.6, 0, 0.8], w1 = 0.4, w2 = 0.9, w3 = -0.3 }
step = 0.05
steps = 2000
)toml");
    CHECK(top.value["status"].text == "ok");
    CHECK(top.last(3) == Approx(-0.64).epsilon(1e-12)); // hanging
}

TEST_CASE("a discrete pendulum that stands upright falls by rounding, and no step fails", "[run]")
{
    const Rest upright = rest_of(R"toml(
[base]
coordinates = ["th"]
[fibre]
coordinates = ["u"]
[groupoid]
kind = "pair"
[lagrangian]
L = "u^2/2 + 9.81*cos(th)"
[discrete]
step = "h"
scheme = "midpoint"
[scene.default]
initial = { th = "pi", u = 0 }
step = 0.1
steps = 300
)toml");
    CHECK(upright.value["status"].text == "ok");
    CHECK(upright.told.find("warning") == std::string::npos); // its energy swings
}

TEST_CASE("a slow coordinate beside a fast one is found as by itself", "[run]")
{
    const std::string text = R"toml(
[base]
coordinates = ["X", "th"]
[fibre]
coordinates = ["U", "w"]
[groupoid]
kind = "pair"
[lagrangian]
L = "U^2/2 + w^2/2 + cos(th)"
[discrete]
step = "h"
scheme = "midpoint"
[scene.default]
initial = { X = 0, th = 1e-5, U = SPEED, w = 0 }
step = 0.1
steps = 1000
)toml";
    const auto with = [&](const char* speed) {
        std::string model = text;
        return rest_of(model.replace(model.find("SPEED"), 5, speed)).last(2);
    };
    CHECK(with("1e7") == Approx(with("0")).epsilon(1e-10));
}

TEST_CASE("elements so large that rounding hides their momenta are no arrows, small ones are found to rounding",
          "[run][all]")
{
    const std::string line = R"toml(
[fibre]
coordinates = ["a", "b"]
[groupoid]
kind = "group"
group = "AFF(1)"
[lagrangian]
L = "(a^2 + b^2)/2"
[discrete]
step = "h"
scheme = "midpoint"
)toml",
                      scene = "[scene.default]\ninitial = { a = 1, b = 5 }\nstep = 0.5\nsteps = 40\n";
    // F^-L of AFF(1) by Cayley's map is bounded on the branch of 1; W of 1e18 has any momenta, to 1e-16 of N W.
    const Rest none = rest_of(line + scene);
    CHECK(none.value["status"].text == "no_solution");
    CHECK(none.value["branches"].size() == 0);
    CHECK(none.told.find("e+1") == std::string::npos);
    CHECK(rest_of(line + scene, {"--step", "0.05", "--t-end", "0.2"}).value["status"].text == "ok");
    CHECK(rest_of(line + "retraction = \"exp\"\n" + scene).value["status"].text == "ok");
}
