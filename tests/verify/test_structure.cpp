// SPDX-License-Identifier: GPL-2.0-or-later
/// Structure equations, tangency and Casimirs: what is checked, what is counted as trivial, and what refutations say.
#include "verify/algebroid_texts.hpp"
#include "verify/checking.hpp"

#include "geometry/structure_equations.hpp"
#include "graph/core/evaluate.hpp"
#include "support/tolerances.hpp"
#include "symbolic/ginac_door.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>

using namespace lagen;
using Lines = std::vector<std::string>;

namespace {

const std::string sphere = turning_vector(on_sphere + "casimirs = { a = \"g1^2 + g2^2 + g3^2\" }\n");

} // namespace

TEST_CASE("the half-plane frame is valid with [a, b] = -a")
{
    const ModelReport verified = verified_text(half_plane_frame + "\"a,b\" = { a = -1 }\n");
    CHECK(verified.structure.verdict == Verdict::valid);
    CHECK(lines_of(verified) == Lines{"anchor(a, b, x) proved"});
    CHECK(verified.structure.trivial == 1);
    CHECK(verified.mechanics.regularity.kind == Regularity::Kind::absent);
}

TEST_CASE("a wrong sign in a bracket is refuted with a witness, and the hint names the entry")
{
    const ModelReport verified = verified_text(half_plane_frame + "\"a,b\" = { a = 1 }\n");
    CHECK(verified.structure.verdict == Verdict::invalid);
    REQUIRE(lines_of(verified) == Lines{"anchor(a, b, x) refuted"});
    const Check& check = verified.structure.checks[0];
    CHECK(check.decision.residual == "-2*y");
    REQUIRE(check.decision.witness);
    const auto& point = check.decision.witness->point;
    REQUIRE(point.size() == 1);
    CHECK(point[0].first == "y");
    CHECK(check.decision.witness->value == -2 * to_double(point[0].second));
    CHECK(check.hint == "all equations of the algebroid hold with the opposite sign of component a of [a, b], or with "
                        "the opposite sign of component y of the anchor of b");
}

TEST_CASE("a refutation that no single entry repairs has no hint")
{
    const ModelReport verified =
        verified_text("[fibre]\ncoordinates = [\"a\", \"b\", \"c\"]\n[algebroid]\nkind = \"lie_algebra\"\n"
                      "[algebroid.bracket]\n\"a,b\" = { a = 1 }\n\"b,c\" = { b = 1 }\n\"c,a\" = { c = 1 }\n");
    REQUIRE(verified.structure.verdict == Verdict::invalid);
    for (const Check& check : verified.structure.checks) CHECK(check.hint.empty());
}

TEST_CASE("on the sphere every tangency and Casimir equation is listed and proved")
{
    const ModelReport verified = verified_text(sphere);
    CHECK(verified.structure.verdict == Verdict::valid);
    CHECK(lines_of(verified) ==
          Lines{"anchor(w1, w2, g1) proved", "anchor(w1, w2, g2) proved", "anchor(w1, w3, g1) proved",
                "anchor(w1, w3, g3) proved", "anchor(w2, w3, g2) proved", "anchor(w2, w3, g3) proved",
                "tangency(w1, g1^2 + g2^2 + g3^2 - 1) proved", "tangency(w2, g1^2 + g2^2 + g3^2 - 1) proved",
                "tangency(w3, g1^2 + g2^2 + g3^2 - 1) proved", "casimir(w1, a) proved", "casimir(w2, a) proved",
                "casimir(w3, a) proved"});
    CHECK(verified.structure.trivial == 6);
}

TEST_CASE("an anchor that leaves the surface is refuted at a point of the surface")
{
    std::string text = sphere;
    text.replace(text.find("w1 = { g2 = \"g3\""), 16, "w1 = { g2 = \"g1\"");
    const ModelReport verified = verified_text(text);
    CHECK(verified.structure.verdict == Verdict::invalid);
    const auto found = std::find_if(verified.structure.checks.begin(), verified.structure.checks.end(),
                                    [](const Check& check) { return check.name == "tangency"; });
    REQUIRE(found != verified.structure.checks.end());
    CHECK(line_of(*found) == "tangency(w1, g1^2 + g2^2 + g3^2 - 1) refuted");
    CHECK(found->decision.witness->point.size() == 3);
}

TEST_CASE("brackets given in both orders must be opposite")
{
    const std::string head =
        "[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\nkind = \"lie_algebra\"\n[algebroid.bracket]\n";
    const ModelReport wrong = verified_text(head + "\"a,b\" = { b = 1 }\n\"b,a\" = { b = 1 }\n");
    CHECK(lines_of(wrong) == Lines{"antisymmetry(a, b, b) refuted"});
    CHECK(wrong.structure.checks[0].decision.residual == "2");
    CHECK(wrong.structure.trivial == 1);
    const ModelReport right = verified_text(head + "\"a,b\" = { b = 1 }\n\"b,a\" = { b = -1 }\n");
    CHECK(lines_of(right) == Lines{"antisymmetry(a, b, b) proved"});
    CHECK(right.structure.verdict == Verdict::valid);
    const ModelReport alone = verified_text(head + "\"b,a\" = { b = -1 }\n");
    CHECK(alone.structure.checks.empty());
    CHECK(alone.structure.verdict == Verdict::valid);
}

TEST_CASE("so(5) and gl(4) by name satisfy Jacobi in every index")
{
    for (const auto& [name, rank] : {std::pair("so(5)", 10), std::pair("gl(4)", 16), std::pair("so(3) + R^2", 5)}) {
        std::string coordinates;
        for (int a = 0; a < rank; ++a) coordinates += (a == 0 ? "\"y" : ", \"y") + std::to_string(a) + "\"";
        const ModelReport verified =
            verified_text("[fibre]\ncoordinates = [" + coordinates +
                          "]\n[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"" + name + "\"\n");
        INFO(name);
        CHECK(verified.structure.verdict == Verdict::valid);
        const auto r = static_cast<std::size_t>(rank);
        CHECK(verified.structure.checks.size() + verified.structure.trivial == r * (r - 1) * (r - 2) / 6 * r);
        CHECK(verified.algebroid.C.size() > 0);
    }
}

TEST_CASE("a named algebra of another rank is refused where it is named")
{
    CHECK_THROWS_WITH(
        verified_text(
            "[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"so(3)\"\n"),
        "test.toml:6:11: error: the Lie algebra so(3) has rank 3, where the number of fibre coordinates is 2\n"
        "  algebra = \"so(3)\"\n            ^~~~~~~\nhint: give [fibre] one coordinate for each basis element");
}

TEST_CASE("a division by something that is zero everywhere is refused where it stands")
{
    CHECK_THROWS_WITH(verified_text("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n"
                                    "[algebroid.anchor]\nv = { x = \"1/(sin(x)^2 + cos(x)^2 - 1)\" }\n"),
                      Catch::Contains("division by sin(x)^2 + cos(x)^2 - 1, which is zero everywhere") &&
                          Catch::Contains("test.toml:7:") &&
                          Catch::Contains("hint: a divisor must be nonzero somewhere on the domain"));
}

TEST_CASE("constraints that are not triangular are refused at the constraint")
{
    CHECK_THROWS_WITH(verified_text("[base]\ncoordinates = [\"x\", \"y\"]\nconstraints = [\"sin(x) + sin(y)\"]\n"
                                    "[fibre]\ncoordinates = [\"v\"]\n[algebroid.anchor]\nv = { x = 1 }\n"),
                      Catch::StartsWith("test.toml:4:17: error: ") &&
                          Catch::Contains("hint: each constraint must solve for a base coordinate"));
}

TEST_CASE("a model that is defined nowhere is undecided and says so")
{
    const ModelReport verified = verified_text("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n"
                                               "[algebroid.anchor]\nv = { x = \"sqrt(-1 - x^2)\" }\n");
    CHECK(verified.structure.verdict == Verdict::undecided);
    CHECK(verified.structure.note ==
          "no point was found where everything in the model is defined and every condition of [base] holds");
}

// The second route: residuals formed in GiNaC by differentiation of expanded expressions.
TEST_CASE("anchor residuals from GiNaC and from the graph agree at points where they are not zero")
{
    const Model model = read_model_text("test.toml", "name = \"test\"\n" + std::string(R"toml(
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["a", "b"]
[algebroid.anchor]
a = { x = "-y*(x^2 + y^2)", y = "x*sin(x*y)" }
b = { x = "x/(1 + y^2)", y = "exp(y)" }
[algebroid.bracket]
"a,b" = { a = "x", b = "y*cos(x)" }
)toml"));
    const WrittenAlgebroid algebroid = build_algebroid(model);
    SymbolTable symbols;
    const GiNaC::realsymbol x[] = {symbols.symbol("x"), symbols.symbol("y")};
    GiNaC::ex rho[2][2] = {};
    for (const AnchorValue& entry : algebroid.rho) rho[entry.i][entry.a] = to_ginac(entry.value, symbols);
    GiNaC::ex C[2] = {};
    for (const StructureValue& entry : algebroid.C) C[entry.c] = to_ginac(entry.value, symbols);
    Graph graph;
    Lowering lower(graph);
    const Algebroid lowered = lower_algebroid(graph, lower, algebroid);
    BaseGradient partial(graph, lowered.x);
    const ResidualList list = structure_equations(partial, lowered);
    REQUIRE(list.residuals.size() == 2);
    const std::map<std::string, double> point = {{"x", 0.7}, {"y", -1.3}};
    for (std::size_t i = 0; i < 2; ++i) {
        GiNaC::ex residual;
        for (std::size_t k = 0; k < 2; ++k)
            residual += rho[k][0] * rho[i][1].diff(x[k]) - rho[k][1] * rho[i][0].diff(x[k]) - rho[i][k] * C[k];
        const Tree tree = from_ginac(residual.expand(), symbols, {{}, {"x", "y"}});
        const NodeId outputs[] = {lower(tree), list.residuals[i].value};
        const std::vector<double> values = evaluate<double>(graph, outputs, point);
        CHECK(std::abs(values[0]) > 0.1);
        CHECK(std::abs(values[0] - values[1]) <= tolerance::roundoff(100) * std::abs(values[0]));
    }
}

TEST_CASE("what is zero by structure is counted, not visited: a chain of 800 masses takes a second")
{
    const std::clock_t begin = std::clock();
    const std::size_t n = 800;
    const ModelReport verified = verified_text("[sizes]\nn = 800\n[base]\ncoordinates = [\"x[1..n]\"]\n[algebroid]\n"
                                               "kind = \"tangent\"\n[lagrangian]\nL = \"dot(v_x, v_x)/2 - sum(i, 1, "
                                               "n - 1, (x[i+1] - x[i])^2)/2\"\n");
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    CHECK(verified.structure.verdict == Verdict::valid);
    CHECK(verified.structure.checks.empty());
    CHECK(verified.structure.trivial == n * n * (n - 1) / 2 + n * (n * (n - 1) * (n - 2) / 6)); // (S1) and (S2)
    CHECK(verified.mechanics.regularity.positive_definite);
    CHECK(seconds < 10); // of the processor; a visit of each takes longer in a release build
}

TEST_CASE("sparse brackets are decided one by one, however many sections there are")
{
    // Two hundred copies of so(3).
    Graph graph;
    const std::size_t copies = 200, r = 3 * copies;
    std::vector<NodeId> y;
    for (std::size_t a = 0; a < r; ++a) y.push_back(graph.input("y" + std::to_string(a)));
    AlgebroidBuilder builder(graph, {}, r);
    for (std::size_t k = 0; k < r; k += 3)
        for (std::size_t a = 0; a < 3; ++a)
            builder.add_bracket(k + (a + 2) % 3, k + a, k + (a + 1) % 3, graph.constant(1));
    const Algebroid algebroid = builder.finish(y);
    BaseGradient partial(graph, algebroid.x);
    const std::clock_t begin = std::clock();
    const ResidualList list = structure_equations(partial, algebroid);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    CHECK(list.residuals.empty());
    CHECK(list.trivial == r * (r * (r - 1) * (r - 2) / 6));
    CHECK(seconds < 1);
}

TEST_CASE("a witness shows the symbols that occur in the residual, and what a constraint ties to them")
{
    const auto names_at = [](const std::string& text) {
        std::vector<std::string> names;
        for (const Check& check : verified_text(text).structure.checks)
            if (check.decision.witness && names.empty())
                for (const auto& [name, value] : check.decision.witness->point) names.push_back(name);
        return names;
    };
    const std::string plane = "[parameters]\nm = 1\nk = 2\n[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n";
    const std::string free = "[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"m*(v_x^2 + v_y^2 + v_z^2)/2\"\n";
    CHECK(names_at(plane + "casimirs = { f = \"k*x^2 + y - y\" }\n" + free) == std::vector<std::string>{"x", "k"});
    const std::string turning = "[fibre]\ncoordinates = [\"w\"]\n[algebroid.anchor]\nw = { x = \"-y\", y = \"x\" }\n";
    CHECK(names_at(plane + "constraints = [\"x^2 + y^2 - 1\"]\ncasimirs = { f = \"x\" }\n" + turning) ==
          std::vector<std::string>{"x", "y"});
}
