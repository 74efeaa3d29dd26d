// SPDX-License-Identifier: GPL-2.0-or-later
/// A point counts where everything in the model is defined as it is written, in every block: what folds away, sqrt(x)^2
/// or 0*log(x), still says where. Each model is valid, and is not where the folded part is taken out.
#include "checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

struct Folded {
    const char* block;
    const char* text;
    const char* part;  ///< folds away
    const char* plain; ///< the same value, defined everywhere
};

const Folded folded_models[] = {
    {"a constraint", R"toml([base]
coordinates = ["x", "y"]
constraints = ["y - sqrt(x)^2"]
[fibre]
coordinates = ["a", "b"]
[algebroid]
kind = "general"
[algebroid.anchor]
a = { x = "1", y = "1" }
[algebroid.bracket]
"a,b" = { a = "abs(x) - x" }
)toml",
     "sqrt(x)^2", "x"},
    {"the domain", R"toml([base]
coordinates = ["x"]
domain = ["sqrt(x)^2 > -1"]
[fibre]
coordinates = ["a", "b"]
[algebroid]
kind = "general"
[algebroid.anchor]
a = { x = "1" }
[algebroid.bracket]
"a,b" = { a = "abs(x) - x" }
)toml",
     "sqrt(x)^2 > -1", "x^2 > -1"},
    {"a section of a frame", R"toml([base]
coordinates = ["x"]
[fibre]
coordinates = ["u", "v"]
[algebroid]
kind = "frame"
[algebroid.of]
kind = "general"
fibre = ["a", "b"]
[algebroid.of.anchor]
a = { x = "1" }
[algebroid.of.bracket]
"a,b" = { a = "abs(x) - x" }
[algebroid.sections]
u = { a = "1 + 0*log(x)" }
v = { b = "1" }
)toml",
     "1 + 0*log(x)", "1"},
    {"an inner anchor", R"toml([base]
coordinates = ["x"]
[fibre]
coordinates = ["u", "v"]
[algebroid]
kind = "frame"
[algebroid.of]
kind = "general"
fibre = ["a", "b"]
[algebroid.of.anchor]
a = { x = "1 + sqrt(x)^2" }
[algebroid.of.bracket]
"a,b" = { a = "abs(x) - x" }
[algebroid.sections]
u = { a = "1" }
v = { b = "1" }
)toml",
     "1 + sqrt(x)^2", "1 + x^2"},
    {"a representation", R"toml([parameters]
p = 1
[base]
coordinates = ["x"]
[fibre]
coordinates = ["a", "b"]
[algebroid]
kind = "action"
representation = ["[[sqrt(p)^2]]", "[[0]]"]
[algebroid.bracket]
"a,b" = { a = "abs(p) - p" }
)toml",
     "sqrt(p)^2", "p"},
    {"a connection", R"toml([parameters]
p = 1
[base]
coordinates = ["x"]
[fibre]
coordinates = ["h", "a", "b"]
[algebroid]
kind = "atiyah"
[algebroid.bracket]
"a,b" = { a = "1" , b = "0"}
"b,a" = { a = "-1 + (abs(p)-p)" }
[algebroid.connection]
x = { a = "sqrt(p)^2" }
)toml",
     "sqrt(p)^2", "p"},
    {"an invariant", R"toml([base]
coordinates = ["x"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v_x^2/2"
[invariants]
J = "v_x*(1 + (abs(x) - x)*(1 + 0*log(x)))"
)toml",
     "0*log(x)", "0"},
};

} // namespace

TEST_CASE("what folds away in any block still says where the model is defined")
{
    for (const Folded& model : folded_models) {
        INFO(model.block);
        std::string text = model.text;
        CHECK(verified_text(text).structure.verdict == Verdict::valid);
        const std::size_t at = text.find(model.part);
        REQUIRE(at != std::string::npos);
        text.replace(at, std::string(model.part).size(), model.plain);
        CHECK(verified_text(text).structure.verdict == Verdict::invalid);
    }
}

TEST_CASE("a coordinate with s^2 = 4 is no square root: both of its signs count")
{
    const std::string text = R"toml(
[base]
coordinates = ["x", "s"]
constraints = ["s^2 - 4"]
[fibre]
coordinates = ["a", "b"]
[algebroid]
kind = "general"
[algebroid.anchor]
a = { x = "1" }
b = { x = "x*(sqrt(5 + 2*s) - 3)" }
)toml";
    CHECK(verified_text(text).structure.verdict == Verdict::invalid); // at s = -2
    std::string positive = text;
    positive.insert(positive.find("[fibre]"), "domain = [\"s > 0\"]\n");
    CHECK(verified_text(positive).structure.verdict == Verdict::valid);
}

TEST_CASE("the unknowns of two linear systems are not the same because they are numbered alike")
{
    std::string row = "1", ones;
    for (int k = 1; k < 9; ++k) row += ",1";
    for (int k = 0; k < 9; ++k) ones += (k > 0 ? ",[" : "[") + row + "]";
    const std::string text = R"toml(
[parameters]
p = 1
q = 0.000001
[base]
coordinates = ["x", "y", "u"]
domain = ["p > 1/2", "q > 0", "q < 1/100000"]
[fibre]
coordinates = ["a", "b"]
[definitions]
N = "[)toml" + ones + R"toml(]"
U = "inverse(p*identity(9) + q*N)*[1000 - x, 1, 1, 1, 1, 1, 1, 1, 1]"
V = "inverse((p + 1)*identity(9) + q*N)*[y, 1, 1, 1, 1, 1, 1, 1, 1]"
[algebroid]
kind = "general"
[algebroid.anchor]
a = { u = "1" }
[algebroid.bracket]
"a,b" = { a = "(abs(U[1]) - U[1])*(abs(V[1]) + V[1])" }
)toml";
    CHECK(verified_text(text).structure.verdict != Verdict::valid); // at x = 2000, y = 1: U[1] < 0 < V[1]
}

TEST_CASE("an empty bracket says zero, which the other order must agree with")
{
    const std::string text = R"toml(
[fibre]
coordinates = ["a", "b", "c"]
[algebroid]
kind = "general"
[algebroid.bracket]
"a,b" = { c = 1 }
"b,a" = { }
)toml";
    const ModelReport verified = verified_text(text);
    CHECK(verified.structure.verdict == Verdict::invalid);
    REQUIRE_FALSE(verified.structure.checks.empty());
    CHECK(verified.structure.checks[0].name == "antisymmetry");
}

TEST_CASE("six coupled sections that are linearly dependent are no frame")
{
    const std::string text = R"toml(
[fibre]
coordinates = ["u[1..6]"]
[algebroid]
kind = "frame"
[algebroid.of]
kind = "lie_algebra"
fibre = ["w[1..6]"]
algebra = "R^6"
[algebroid.sections]
"u[1]" = { "w[1]" = "1", "w[2]" = "1" }
"u[2]" = { "w[2]" = "1", "w[3]" = "1" }
"u[3]" = { "w[3]" = "1", "w[4]" = "1" }
"u[4]" = { "w[4]" = "1", "w[5]" = "1" }
"u[5]" = { "w[5]" = "1", "w[6]" = "1" }
"u[6]" = { "w[6]" = "1", "w[1]" = "1" }
)toml";
    CHECK_THROWS_WITH(verified_text(text),
                      Catch::StartsWith("test.toml:12:21: error: the sections of the frame are linearly dependent at "
                                        "every point tried: the determinant of 'sections' is zero there"));
    std::string independent = text;
    independent.replace(independent.rfind("\"w[1]\" = \"1\""), 12, "\"w[1]\" = \"2\"");
    CHECK(verified_text(independent).structure.verdict == Verdict::valid);
}
