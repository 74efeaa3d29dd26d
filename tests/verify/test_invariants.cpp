// SPDX-License-Identifier: GPL-2.0-or-later
/// Conserved quantities along Lagrange's equations, proved and refuted.
#include "verify/algebroid_texts.hpp"
#include "verify/claim_statuses.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

const std::string rigid_body = R"(
[parameters]
I1 = 1
I2 = 2
I3 = 3
[fibre]
coordinates = ["w1", "w2", "w3"]
[algebroid]
kind = "lie_algebra"
)" + so3_bracket + R"([lagrangian]
L = "(I1*w1^2 + I2*w2^2 + I3*w3^2)/2"
)";

std::string heavy_top(const std::string& lagrangian)
{
    return "[parameters]\nI1 = 1\nI2 = 2\nI3 = 3\nmgl = 5\n" + turning_vector(on_sphere) + "[lagrangian]\nL = \"" +
           lagrangian + "\"\n";
}

std::string plane(const std::string& lagrangian, const std::string& more = "")
{
    return "[parameters]\nk = 1\n[base]\ncoordinates = [\"x\", \"y\"]\n" + more +
           "[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"" + lagrangian +
           "\"\n";
}

} // namespace

TEST_CASE("the free rigid body conserves energy and |Pi|^2 but no single momentum")
{
    CHECK(statuses(rigid_body, {"energy", "I1*w1^2 + I2*w2^2 + I3*w3^2", "I1^2*w1^2 + I2^2*w2^2 + I3^2*w3^2",
                                "p_w1^2 + p_w2^2 + p_w3^2", "p_w1", "w1^2 + w2^2 + w3^2"}) ==
          "proved, proved, proved, proved, refuted, refuted");
}

TEST_CASE("the heavy top conserves area and length of the vertical, Lagrange's top also I3 w3")
{
    const std::vector<std::string> claims = {"g1^2 + g2^2 + g3^2", "I1*w1*g1 + I2*w2*g2 + I3*w3*g3", "energy", "I3*w3"};
    CHECK(statuses(heavy_top("(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 - mgl*g3"), claims) == "proved, proved, proved, refuted");
    CHECK(statuses(heavy_top("(I1*(w1^2 + w2^2) + I3*w3^2)/2 - mgl*g3"),
                   {"g1*p_w1 + g2*p_w2 + g3*p_w3", "I3*w3", "w3"}) == "proved, proved, proved");
}

TEST_CASE("Kepler's problem conserves angular momentum and the Laplace vector")
{
    CHECK(statuses(plane("(u^2 + v^2)/2 + k/sqrt(x^2 + y^2)"),
                   {"x*v - y*u", "v*(x*v - y*u) - k*x/sqrt(x^2 + y^2)", "-u*(x*v - y*u) - k*y/sqrt(x^2 + y^2)",
                    "-u*(x*v - y*u) + k*y/sqrt(x^2 + y^2)", "energy"}) ==
          "proved, proved where x^2 + y^2 != 0, proved where x^2 + y^2 != 0, refuted, proved where x^2 + y^2 != 0");
}

TEST_CASE("the Henon-Heiles system conserves energy only")
{
    CHECK(statuses(plane("(u^2 + v^2)/2 - (x^2 + y^2)/2 - x^2*y + y^3/3"),
                   {"(u^2 + v^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3", "x*v - y*u"}) == "proved, refuted");
}

TEST_CASE("a coupled mass matrix is solved exactly for the accelerations")
{
    const std::string coupled = plane("(2*u^2 + 2*u*v*cos(x - y) + v^2)/2 + 2*cos(x) + cos(y)");
    CHECK(statuses(coupled, {"(2*u^2 + 2*u*v*cos(x - y) + v^2)/2 - 2*cos(x) - cos(y)", "energy", "u"}) ==
          "proved, proved, refuted");
}

TEST_CASE("energy is refuted as an invariant where L depends on time")
{
    CHECK(statuses(plane("(u^2 + v^2)/2 - x*sin(t)"), {"energy", "v"}) == "refuted, proved");
}

TEST_CASE("base coordinates that no section moves are invariants")
{
    const std::string duffing = R"(
[base]
coordinates = ["q", "k", "c"]
[fibre]
coordinates = ["v"]
[algebroid]
kind = "tangent"
over = ["q"]
[lagrangian]
L = "v^2/2 - k*q^2/2 - c*q^4/4"
)";
    CHECK(statuses(duffing, {"k", "c", "k*c + c^2", "q"}) == "proved, proved, proved, refuted");
}

TEST_CASE("a degenerate Lagrangian leaves undecided what needs its accelerations")
{
    const std::string text = plane("u^2/2 - x^2/2 + v*y");
    CHECK(statuses(text, {"energy", "u", "v"}) == "proved, refuted, undecided");
    const ModelReport verified = verified_text(text, {{"v", name("v"), {}}});
    CHECK(verified.mechanics.regularity.kind == Regularity::Kind::degenerate);
    CHECK(verified.mechanics.regularity.rank == 1);
    CHECK(verified.structure.checks.back().decision.evidence ==
          "the Lagrangian is degenerate, so that the equations of motion do not determine the accelerations");
    CHECK(verified.structure.verdict == Verdict::undecided);
}

TEST_CASE("a degenerate Lagrangian refutes nothing where its motions may fill a part of E alone")
{
    // d/dt (y) = dL/dy of w: y = 0 along motions, so that y, p_w = y and v w = 0 there are constant.
    const std::string text = plane("x^2*u^2/2 + v*y - y^2/2");
    CHECK(statuses(text, {"energy", "y", "p_v - y"}) == "proved, undecided, undecided");
    CHECK(verified_text(text, {{"y", name("y"), {}}}).structure.checks.back().decision.evidence ==
          "its rate is not zero at every point of E, but the Lagrangian is degenerate and its motions may fill a part "
          "of E alone");
}

TEST_CASE("without a Lagrangian only functions on the base can be invariant")
{
    const std::string text = "[base]\ncoordinates = [\"x\", \"k\"]\n[fibre]\ncoordinates = [\"v\"]\n[algebroid]\nkind "
                             "= \"tangent\"\nover = [\"x\"]\n";
    CHECK(statuses(text, {"k", "x", "v"}) == "proved, refuted, undecided");
}

TEST_CASE("an invariant with a logarithm is a claim about the points where the logarithm is defined")
{
    // |x| - x is not constant where x < 0, but log(x) is not defined there.
    CHECK(statuses(plane("(u^2 + v^2)/2"), {"abs(x) - x + log(2*x) - log(x)", "abs(x) - x", "log(-1 - x^2)"}) ==
          "proved where x > 0, refuted, undecided");
    CHECK(statuses(plane("(u^2 + v^2)/2"), {"abs(p_u) - u + log(2*p_u) - log(u)"}) == "proved");
}

TEST_CASE("invariants may hold on the constraint alone and may depend on time")
{
    const std::string top = heavy_top("(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 - mgl*g3");
    CHECK(statuses(top, {"energy*(g1^2 + g2^2 + g3^2)", "energy*(g1^2 + g2^2 + g3^2 - 2)",
                         "energy*(g1^2 + g2^2 + g3^2 - 1) + g3*0", "(g1^2 + g2^2 + g3^2 - 1)*t", "g3*t"}) ==
          "proved, proved, proved, proved, refuted");
    const std::string falling = plane("(u^2 + v^2)/2 - k*y");
    CHECK(statuses(falling, {"y - v*t - k*t^2/2", "v + k*t", "v - k*t", "x - u*t", "energy + t"}) ==
          "proved, proved, refuted, proved, refuted");
}

TEST_CASE("a Lagrangian that is not quadratic has its own mass matrix in each invariant")
{
    // p = v/sqrt(1 - v^2) for the relativistic particle, W = (1 - v^2)^(-3/2)
    const std::string relativistic = plane("-sqrt(1 - u^2 - v^2) - x^2/2");
    CHECK(statuses(relativistic, {"energy", "v/sqrt(1 - u^2 - v^2)", "1/sqrt(1 - u^2 - v^2) + x^2/2",
                                  "1/sqrt(1 - u^2 - v^2) - x^2/2", "v"}) ==
          "proved where 1 - u^2 - v^2 > 0, proved where 1 - u^2 - v^2 > 0, proved where 1 - u^2 - v^2 > 0, refuted, "
          "refuted");
    CHECK(statuses(relativistic, {"sqrt(1 + p_u^2 + p_v^2) + x^2/2", "sqrt(1 + p_u^2 + p_v^2) - x^2/2"}) ==
          "proved where 1 - u^2 - v^2 > 0, refuted");
    // W = diag(x, 1) is singular at x = 0: x u^2 is conserved wherever the accelerations exist.
    CHECK(statuses(plane("(x*u^2 + v^2)/2"), {"x*u^2", "x*u", "v"}) == "proved where x != 0, refuted, proved");
    CHECK(statuses(plane("exp(k*t)*(u^2 - x^2)/2 + v^2/2"), {"p_u", "v", "energy"}) == "refuted, proved, refuted");
}

TEST_CASE("a momentum that is written out is decided as the momentum, which needs no accelerations")
{
    // Its motions have x = y, where u + v is constant.
    CHECK(statuses(plane("(u + v)^2/2 - k*(x - y)^4"), {"u + v", "2*u + v", "u"}) == "undecided, undecided, undecided");
    CHECK(statuses(plane("(u + v)^2/2"), {"u + v", "v + u + 1", "u"}) == "proved, undecided, undecided");
    CHECK(statuses(plane("exp(y)*(u*(1 + y^2) + v)^2/2"),
                   {"exp(y)*(1 + y^2)*(u + u*y^2 + v)", "exp(y)*(1 + y^2)*(u - u*y^2 + v)"}) == "proved, undecided");
}

TEST_CASE("work balances energy, and claims with first-order states are decided along all rates")
{
    const std::string driven = plane("(u^2 + v^2)/2", "") +
                               "[forces]\nu = \"z - u\"\n"
                               "[states]\nz = \"k*(v - z)\"\nwork = \"(z - p_u)*u\"\nturn = \"x*v - y*u\"\n";
    CHECK(statuses(driven, {"energy - work", "energy", "x + u - work", "k*y - turn", "v"}) ==
          "proved, refuted, refuted, refuted, proved");
}
