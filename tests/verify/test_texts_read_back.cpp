// SPDX-License-Identifier: GPL-2.0-or-later
/// Normal forms become expressions where an algebroid is built, and tell assumptions apart: no two may be one tree, and
/// none may stand for another.
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

const std::string line = "domain = ['x > 0']\n[fibre]\ncoordinates = ['a', 'b']\n[algebroid]\nkind = 'frame'\n"
                         "[algebroid.of]\nkind = 'tangent'\nfibre = ['u', 'v']\n[algebroid.sections]\n";

std::string statuses(const Report& verified)
{
    std::string text;
    for (const std::string& each : lines_of(verified)) text += each + "; ";
    return text;
}

} // namespace

TEST_CASE("powers of a fractional root keep their exponent in a frame")
{
    const ModelReport verified =
        verified_text("[base]\ncoordinates = ['x', 'y']\n" + line +
                      "a = { u = 'x^(1/3)*x^(1/3)' }\nb = { v = 1 }\n[lagrangian]\nL = '(a^2+b^2)/2'\n[invariants]\n"
                      "wrong = '9/8*x^(8/9) - t*a'\nright = '3*x^(1/3) - t*a'\n");
    CHECK(statuses(verified) == "invariant(wrong) refuted; invariant(right) proved; ");
    CHECK(verified_text("[base]\ncoordinates = ['x', 'y']\n" + line +
                        "a = { u = '1' }\nb = { v = '(x^(1/3)+1)^2-1-2*x^(1/3)' }\n")
              .structure.verdict == Verdict::valid);
}

TEST_CASE("multiples of a constrained coordinate are squared as a whole")
{
    const std::string curve = "[base]\ncoordinates = ['x', 'y', 'z']\nconstraints = ['2*y^3 - exp(x)']\n[fibre]\n"
                              "coordinates = ['b']\n[algebroid]\nkind = 'frame'\n[algebroid.of]\nkind = 'general'\n"
                              "fibre = ['v']\n[algebroid.of.anchor]\n";
    const std::string section = "[algebroid.sections]\nb = { v = 'cos(y^2 + sin(x)^2 + cos(x)^2 - 1)' }\n";
    CHECK(verified_text(curve + "v = { x = 3, y = 'y' }\n" + section).structure.verdict == Verdict::valid);
    const ModelReport verified = verified_text(curve + "v = { z = '1' }\n" + section);
    REQUIRE(verified.algebroid.rho.size() == 1);
    CHECK(to_text(verified.algebroid.rho[0].value) == "cos(y^2)");
}

TEST_CASE("a coordinate called pi is not the number")
{
    // |A| B = A |B| fails where A = x - 100 pi and B = x - 200 (acos y + asin y) have different signs.
    const ModelReport absolute = verified_text(
        "[base]\ncoordinates = ['x', 'y', 'pi']\ndomain = ['y > 0', 'y < 1', 'pi > 4']\n[fibre]\ncoordinates = ['a']\n"
        "[algebroid.anchor]\na = { x = 'abs(x - 100*pi)*(x - 200*acos(y) - 200*asin(y)) - (x - 100*pi)*abs(x - "
        "200*acos(y) - 200*asin(y))' }\n[lagrangian]\nL = 'a^2/2'\n[invariants]\nf = 'x'\n");
    CHECK(absolute.structure.verdict != Verdict::valid);
    const ModelReport frame =
        verified_text("[base]\ncoordinates = ['x', 'y', 'pi']\n[fibre]\ncoordinates = ['a', 'b']\n[algebroid]\nkind = "
                      "'frame'\n[algebroid.of]\nkind = 'tangent'\nover = ['x', 'y']\nfibre = ['u', 'v']\n"
                      "[algebroid.sections]\na = { u = 1 }\nb = { v = 'exp(x*(pi + 2*acos(y) + 2*asin(y)))' }\n");
    CHECK(frame.structure.verdict == Verdict::valid);
    REQUIRE(frame.algebroid.rho.size() == 2);
    Graph graph;
    const NodeId value = Lowering(graph)(frame.algebroid.rho[1].value);
    CHECK_FALSE(graph.is_zero(gradient(graph, value, std::vector{graph.input("pi")})[0]));
}

TEST_CASE("the number pi of an included file is not what another file calls pi")
{
    const Model model = read_model_text(std::string(LAGEN_SOURCE_DIR) + "/tests/data/kinds/product_of_pi.toml",
                                        "name = 'test'\n[algebroid]\nkind = 'product'\n"
                                        "of = ['pi_declared.toml', 'pi_number.toml']\n"
                                        "[invariants]\nb = 'vb^2/2 + cos(pi_of_b*q)'\n"
                                        "[parameters]\npi_of_b = 1\n");
    Graph graph;
    const NodeId L = Lowering(graph)(model.lagrangian);
    const NodeId r = graph.input("r");
    const NodeId q = graph.input("q");
    const std::vector<NodeId> dL = gradient(graph, L, std::vector{r, q});
    CHECK(graph.value(dL[0]) == -3);
    CHECK(graph.is_zero(gradient(graph, dL[1], std::vector{r})[0]));
}

TEST_CASE("the logarithm of a coordinate whose relation leads back to itself is decided in finite time")
{
    const ModelReport verified =
        verified_text("[base]\ncoordinates = ['x', 'y']\nconstraints = ['x^2 - x*y']\ndomain = ['x > 0']\n[fibre]\n"
                      "coordinates = ['a']\n[algebroid.anchor]\na = { y = 'log(x)' }\n");
    CHECK(verified.structure.verdict == Verdict::invalid); // not tangent: h = x^2 - x y moves
}
