// SPDX-License-Identifier: GPL-2.0-or-later
/// The momenta of [symmetries] in `lagen run`: columns, and figures as those of invariants.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

using namespace lagen::testing;
namespace json = lagen::json;

TEST_CASE("the discrete momentum of a rotation is x p_y - y p_x, and a scheme on pairs keeps it", "[run]")
{
    const std::string path = fresh_folder() + "/kepler.toml";
    std::ofstream(path) << R"toml(
name = "kepler"
[base]
coordinates = ["x", "y"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(v_x^2 + v_y^2)/2 + 1/sqrt(x^2 + y^2)"
[discrete]
step = "h"
scheme = "midpoint"
[symmetries]
rotation = { v_x = "-y", v_y = "x" }
[scene.default]
initial = { x = 1, y = 0, v_x = 0, v_y = 1.1 }
step = 0.1
steps = 200
observe = ["x", "y", "p_v_x", "p_v_y", "momentum.rotation"]
)toml";
    const Outcome outcome = done({"run", path, "--format", "json"});
    const json::Value found = json::parse(outcome.out);
    CHECK(found["columns"][5].text == "momentum.rotation");
    REQUIRE(found["rows"].size() == 201);
    const auto number = [](const json::Value& value) { return std::stold(value.text); };
    long double turned = 0;
    for (const json::Value& row : found["rows"].entries) {
        CHECK(std::abs(number(row[1]) * number(row[4]) - number(row[2]) * number(row[3]) - number(row[5])) < 1e-15L);
        turned = std::max(turned, std::abs(number(row[2])));
    }
    CHECK(turned > 1);
    const json::Value& figure = found["invariants"]["momentum.rotation"];
    CHECK(std::abs(number(figure["initial"]) - 1.1L) < 1e-12L);
    CHECK(number(figure["max_drift"]) < 1e-13L);
    CHECK(number(found["invariants"]["energy"]["max_drift"]) > 1e-4L);
}
