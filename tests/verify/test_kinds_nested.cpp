// SPDX-License-Identifier: GPL-2.0-or-later
/// Algebroids made of others: frames, products and prolongations, of inner tables and of files.
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace lagen;

namespace {

/// A model that stands, as far as `of` is concerned, beside the files of tests/data/kinds.
Model nested(const std::string& text)
{
    const auto folder = std::filesystem::path(LAGEN_SOURCE_DIR) / "tests" / "data" / "kinds";
    return read_model_text((folder / "outer.toml").string(), text);
}

std::vector<std::string> names_in_order(const std::vector<Symbol>& symbols)
{
    std::vector<std::string> out;
    for (const Symbol& symbol : symbols) out.push_back(symbol.name);
    return out;
}

/// "a: x y" for rho(e_a) = y d/dx, and "a,b: c z" for [e_a, e_b] = z e_c.
std::vector<std::string> lines_of(const WrittenAlgebroid& algebroid)
{
    std::vector<std::string> lines;
    for (const AnchorValue& entry : algebroid.rho)
        lines.push_back(algebroid.fibre[entry.a].name + ": " + algebroid.base[entry.i].name + " " +
                        to_text(entry.value));
    for (const StructureValue& entry : algebroid.C)
        lines.push_back(algebroid.fibre[entry.a].name + "," + algebroid.fibre[entry.b].name + ": " +
                        algebroid.fibre[entry.c].name + " " + to_text(entry.value));
    return lines;
}

std::string diagnostic_of(const std::string& text)
{
    try {
        (void)build_algebroid(nested(text));
    } catch (const ModelError& error) {
        return error.diagnostic().message + " | " + error.diagnostic().hint;
    }
    return "";
}

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("the prolongation of a file gains its fibre coordinates, or its momenta")
{
    const std::string text = "[algebroid]\nkind = 'prolongation'\nof = 'spin.toml'\n";
    const Model E = nested(text);
    CHECK(names_in_order(E.base.coordinates) == Lines{"w1", "w2", "w3"});
    CHECK(names_in_order(E.fibre.coordinates) == Lines{"X_w1", "X_w2", "X_w3", "V_w1", "V_w2", "V_w3"});
    CHECK(lines_of(build_algebroid(E)) == Lines{"V_w1: w1 1", "V_w2: w2 1", "V_w3: w3 1", "X_w1,X_w2: X_w3 1",
                                                "X_w1,X_w3: X_w2 -1", "X_w2,X_w3: X_w1 1"});
    CHECK(E.lagrangian == nullptr);
    CHECK(E.parameters.size() == 2);
    REQUIRE(E.included.size() == 1);
    CHECK(std::filesystem::path(E.included[0]->name).filename() == "spin.toml");
    const Model dual = nested(text + "bundle = 'E*'\n");
    CHECK(names_in_order(dual.base.coordinates) == Lines{"l1", "l2", "l3"});
    CHECK(names_in_order(dual.fibre.coordinates) == Lines{"X_w1", "X_w2", "X_w3", "P_w1", "P_w2", "P_w3"});
    CHECK(verify(dual).structure.verdict == Verdict::valid);
}

TEST_CASE("the base of a prolongation may be declared without what it gains, or with it")
{
    const std::string of = "[algebroid]\nkind = 'prolongation'\n[algebroid.of]\nkind = 'general'\nfibre = ['a', 'b']\n"
                           "anchor = { a = { x = 'x' } }\nbracket = { 'a,b' = { b = 1 } }\n";
    const Lines expected = {"X_a: x x", "V_a: a 1", "V_b: b 1", "X_a,X_b: X_b 1"};
    CHECK(lines_of(build_algebroid(nested("[base]\ncoordinates = ['x']\n" + of))) == expected);
    CHECK(lines_of(build_algebroid(nested("[base]\ncoordinates = ['x', 'a', 'b']\n" + of))) == expected);
    CHECK(diagnostic_of("[base]\ncoordinates = ['z']\n[algebroid]\nkind = 'prolongation'\nof = 'plane.toml'\n") ==
          "the number of base coordinates is 1, where [algebroid] needs 4: x, y, u, v | leave [base] coordinates out, "
          "or give "
          "exactly these");
}

TEST_CASE("a frame of a file takes over its Lagrangian, written in the new fibre coordinates")
{
    const Model model = nested("[fibre]\ncoordinates = ['a', 'b']\n[algebroid]\nkind = 'frame'\nof = 'plane.toml'\n"
                               "sections = { a = { u = 'x' }, b = { u = 1, v = 'x' } }\n"
                               "[invariants]\nE = 'T + x'\n[observables]\nspeed = 'u'\n");
    CHECK(to_text(model.lagrangian) == "m*((x*a + b)^2 + (x*b)^2)/2 - x");
    CHECK(to_text(model.observables[0].value) == "x*a + b");
    CHECK(model.base.domain.size() == 1);
    const ModelReport verified = verify(model);
    CHECK(verified.structure.verdict == Verdict::valid);
    CHECK(lines_of(verified.algebroid) == Lines{"a: x x", "b: x 1", "b: y x", "a,b: a -2/x", "a,b: b 1"});
}

TEST_CASE("inner velocities of a frame of a frame are functions of the outermost coordinates")
{
    const Model model = nested("[base]\ncoordinates = ['x']\n[fibre]\ncoordinates = ['a']\n[algebroid]\n"
                               "kind = 'frame'\nsections = { a = { b = 'x' } }\n[algebroid.of]\nkind = 'frame'\n"
                               "fibre = ['b']\nsections = { b = { v_x = 'exp(x)' } }\n[algebroid.of.of]\n"
                               "kind = 'tangent'\n[lagrangian]\nL = 'v_x^2/2 - b'\n");
    CHECK(to_text(model.lagrangian) == "(exp(x)*x*a)^2/2 - x*a");
    CHECK(lines_of(build_algebroid(model)) == Lines{"a: x x*exp(x)"});
}

TEST_CASE("the product of two files has their Lagrangians' sum and no brackets across")
{
    const Model model = nested("[algebroid]\nkind = 'product'\nof = ['plane.toml', 'spin.toml']\n");
    CHECK(names_in_order(model.fibre.coordinates) == Lines{"u", "v", "w1", "w2", "w3"});
    CHECK(to_text(model.lagrangian) == "m*(u^2 + v^2)/2 - x + (w1^2 + w2^2 + I*w3^2)/2");
    CHECK(model.parameters.size() == 2);
    CHECK(lines_of(build_algebroid(model)) == Lines{"u: x 1", "v: y 1", "w1,w2: w3 1", "w1,w3: w2 -1", "w2,w3: w1 1"});
    CHECK(verify(model).structure.verdict == Verdict::valid);
}

TEST_CASE("coordinates of factors that clash are renamed by their place")
{
    const std::string product = "[algebroid]\nkind = 'product'\nof = ['spin.toml', 'spin.toml']\n";
    const Model model = nested("[fibre]\ncoordinates = ['a1', 'a2', 'a3', 'b1', 'b2', 'b3']\n" + product);
    CHECK(to_text(model.lagrangian) == "(a1^2 + a2^2 + I*a3^2)/2 + (b1^2 + b2^2 + I*b3^2)/2");
    CHECK(verify(model).structure.verdict == Verdict::valid);
    const std::string twice = "[algebroid]\nkind = 'product'\nof = ['plane.toml', 'plane.toml']\n";
    CHECK_THAT(diagnostic_of(twice), Catch::StartsWith("'x' is a base coordinate of both ") &&
                                         Catch::EndsWith("rename them: [base] coordinates = [..], all 4 in order"));
}

TEST_CASE("files that include each other are refused")
{
    CHECK(diagnostic_of("[algebroid]\nkind = 'prolongation'\nof = 'cycle_a.toml'\n") ==
          "the models include each other in a cycle: cycle_a.toml -> cycle_b.toml -> cycle_a.toml | a file may not be "
          "part of itself");
}

TEST_CASE("so(n) and its prolongations of both kinds are valid up to n = 10")
{
    for (const std::size_t n : {4U, 6U, 8U, 10U}) {
        const std::size_t r = n * (n - 1) / 2;
        const std::string algebra = "algebra = 'so(" + std::to_string(n) + ")'\n";
        const std::string plain =
            "[fibre]\ncoordinates = ['w[1.." + std::to_string(r) + "]']\n[algebroid]\nkind = 'lie_algebra'\n" + algebra;
        const std::string inner =
            "[algebroid.of]\nkind = 'lie_algebra'\nfibre = ['w[1.." + std::to_string(r) + "]']\n" + algebra;
        INFO(algebra);
        CHECK(verify(nested(plain)).structure.verdict == Verdict::valid);
        for (const char* bundle : {"bundle = 'E'\n", "bundle = 'E*'\n"}) {
            const ModelReport verified =
                verify(nested("[algebroid]\nkind = 'prolongation'\n" + std::string(bundle) + inner));
            CHECK(verified.structure.verdict == Verdict::valid);
            CHECK(verified.algebroid.r() == 2 * r);
            CHECK(verified.algebroid.C.size() == n * (n - 1) * (n - 2) / 2);
        }
    }
}

TEST_CASE("names of the model are not captured by parameters and indices of an included file's definitions")
{
    // captured.toml: f(q) = q*x and g(k) = sum(i, 1, 2, i*x*k) with its base coordinate x.
    for (const std::string name : {"q", "k", "i", "unlike"}) {
        INFO(name);
        const Model model = nested("[base]\ncoordinates = ['" + name + R"toml(', 'y', 'z']
[fibre]
coordinates = ['u', 'v', 'w']
[algebroid]
kind = 'product'
of = ['captured.toml', 'plane.toml']
[lagrangian]
L = 'u^2/2 + f(3) + g(5)'
)toml");
        REQUIRE(model.lagrangian);
        Graph graph;
        Lowering lower(graph);
        const NodeId x = graph.input(name);
        const NodeId L = lower(model.lagrangian);
        // 3 x + 5 x + 10 x
        const std::vector<NodeId> dL = gradient(graph, L, std::vector{x});
        CHECK(graph.value(dL[0]) == 18);
    }
}
