// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete Lagrangians made of L by schemes: the Verlet reference, and measured orders on all kinds of groupoid.
#include "geometry/reference_models.hpp"
#include "scheme_models.hpp"

using namespace lagen::testing;
using namespace lagen::testing::schemes;
namespace json = lagen::json;

TEST_CASE("the trapezoidal scheme of a pendulum is Verlet's method", "[run]")
{
    const json::Value file = lagen::read_discrete_case("verlet_pendulum");
    const std::string path = fresh_folder() + "/verlet.toml";
    std::ofstream(path) << "name = \"verlet\"\n"
                        << pairs.text << R"toml([discrete]
step = "h"
scheme = "trapezoidal"
[scene.default]
step = 0.1
initial = { q = 1.2 }
next = { q = 1.18 }
steps = 50
)toml";
    const json::Value found = ran({path});
    const std::vector<json::Value>& steps = file["steps"].entries;
    REQUIRE(found["rows"].size() == steps.size());
    for (std::size_t k = 0; k < steps.size(); ++k) {
        CHECK(std::abs(std::stold(found["rows"][k][1].text) - std::stold(steps[k]["q"].text)) < 1e-14L);
        CHECK(std::abs(std::stold(found["rows"][k][2].text) - std::stold(steps[k]["p"].text)) < 1e-13L);
    }
}

TEST_CASE("a scheme has its order on an action groupoid", "[all]")
{
    require_orders(top, {{"gauss:2", 4}});
}

TEST_CASE("every scheme has its order on pairs, on an action groupoid and on an Atiyah groupoid with a connection",
          "[all]")
{
    const std::vector<SchemeOrder> up_to_six{{"midpoint", 2}, {"trapezoidal", 2}, {"gauss:2", 4},
                                             {"gauss:3", 6},  {"lobatto:3", 4},   {"lobatto:4", 6}};
    const std::vector<SchemeOrder> eight{{"gauss:4", 8, "0.4", "0.2"}, {"lobatto:5", 8, "0.4", "0.2"}};
    for (const SchemeModel* model : {&pairs, &top, &charged, &driven}) require_orders(*model, up_to_six);
    for (const SchemeModel* model : {&pairs, &charged}) require_orders(*model, eight);
    require_orders(pairs, {{"left", 1}});
}
