// SPDX-License-Identifier: GPL-2.0-or-later
/// The reader of the reference data and the model texts made from it.
#include "support/json.hpp"
#include "support/reference_case.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

TEST_CASE("the JSON reader keeps numbers as written, members in order and unescapes texts")
{
    const json::Value value = json::parse(R"( {"b": [1.50, -2e3, true, null], "a": "x\"\\\n\u00e9\u20ac"} )");
    CHECK(value.keys == std::vector<std::string>{"b", "a"});
    CHECK(value["b"].texts() == std::vector<std::string>{"1.50", "-2e3", "true", "null"});
    CHECK(value["b"][1].number() == -2000.0L);
    CHECK(value["a"].text == "x\"\\\n\xc3\xa9\xe2\x82\xac");
}

TEST_CASE("the JSON reader says at which byte it stopped")
{
    CHECK_THROWS_WITH(json::parse("[1, 2"), "JSON: unexpected end at byte 5");
    CHECK_THROWS_WITH(json::parse("{\"a\" 1}"), "JSON: expected : at byte 5");
    CHECK_THROWS_WITH(json::parse("[] x"), "JSON: text after the end at byte 3");
    CHECK_THROWS_WITH(json::parse(std::string(1000, '[')), "JSON: nesting deeper than 200 at byte 201");
}

TEST_CASE("every reference case is complete")
{
    const std::vector<ReferenceCase> cases = read_reference_cases();
    CHECK(cases.size() == 41);
    for (const ReferenceCase& reference : cases) {
        INFO(reference.name);
        const std::size_t lanes = reference.base.size() + reference.fibre.size();
        CHECK(reference.points.size() == 3);
        CHECK(reference.initial.size() == lanes);
        CHECK(reference.rho.size() == reference.base.size());
        CHECK(reference.samples.size() >= 3);
        for (const ReferencePoint& point : reference.points) CHECK(point.state_dot.size() == lanes);
    }
}

TEST_CASE("a reference case is written as a model file of kind general")
{
    for (const ReferenceCase& reference : read_reference_cases())
        if (reference.name == "geodesic_half_plane_orthonormal")
            CHECK(model_text(reference) == R"toml(name = "geodesic_half_plane_orthonormal"

[parameters]

[base]
coordinates = ["x", "y"]

[fibre]
coordinates = ["a", "b"]

[algebroid]
kind = "general"

[algebroid.anchor]
a = { x = "y" }
b = { y = "y" }

[algebroid.bracket]
"a,b" = { a = "-1" }

[lagrangian]
L = "(a^2+b^2)/2"

[scene.default]
observe = ["x", "y", "a", "b"]
initial = { x = "-0.4", y = "0.8", a = "0.7", b = "1.1" }
start = "0"
duration = "5 - (0)"
)toml");
}
