// SPDX-License-Identifier: GPL-2.0-or-later
/// Casimirs in L by name stay names in the equations; written out, they stay written out.
#include "elaborate/build_algebroid.hpp"
#include "equations/derivations.hpp"
#include "model/read_model.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

std::string equations_of(const std::string& lagrangian, const std::string& casimir = "g1^2 + g2^2 + g3^2")
{
    const Model model = read_model_text("test.toml", R"toml(
name = "leaf"
[base]
coordinates = ["g1", "g2", "g3"]
casimirs = { a = ")toml" + casimir + R"toml(" }
[fibre]
coordinates = ["w1", "w2", "w3"]
[algebroid.anchor]
w1 = { g2 = "g3", g3 = "-g2" }
w2 = { g1 = "-g3", g3 = "g1" }
w3 = { g1 = "g2", g2 = "-g1" }
[algebroid.bracket]
"w1,w2" = { w3 = 1 }
"w2,w3" = { w1 = 1 }
"w3,w1" = { w2 = 1 }
[lagrangian]
L = ")toml" + lagrangian + "\"\n");
    return print_text(derive_lagrange(model, build_algebroid(model)));
}

} // namespace

TEST_CASE("a Casimir that L uses by name is a label in the equations, and its value stands once")
{
    const std::string text = equations_of("a*(w1^2 + w2^2 + w3^2)/2 - g3");
    CHECK_THAT(text, Catch::Contains("labels of the leaves (constant along every motion):  ρ_a(f) = 0\n"
                                     "  a = g1² + g2² + g3²\n"));
    CHECK_THAT(text, Catch::Contains("  p_w1 = a w1\n"));
    CHECK_THAT(text, Catch::Contains("  a ẇ1 = g2\n"));
}

TEST_CASE("what L does not use by name has no label")
{
    const std::string text = equations_of("(g1^2 + g2^2 + g3^2)*(w1^2 + w2^2 + w3^2)/2 - g3");
    CHECK_THAT(text, !Catch::Contains("labels"));
    CHECK_THAT(text, Catch::Contains("  p_w1 = w1 (g1² + g2² + g3²)\n"));
}

TEST_CASE("a claimed Casimir that is none is no constant of the equations")
{
    const std::string text = equations_of("a*(w1^2 + w2^2 + w3^2)/2", "g1^2 + g2^2 + 2*g3^2");
    CHECK_THAT(text, !Catch::Contains("labels"));
    CHECK_THAT(text, !Catch::Contains("p_w1 = a w1"));
}
