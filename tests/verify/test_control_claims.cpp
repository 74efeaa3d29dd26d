// SPDX-License-Identifier: GPL-2.0-or-later
/// Conserved quantities of control problems along Pontryagin's equations.
#include "support/json.hpp"
#include "support/reference_case.hpp"
#include "verify/claim_statuses.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

std::string controlled_plane(const std::string& control)
{
    return "[parameters]\nk = 1\n[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"a\", \"b\"]\nmomenta "
           "= "
           "[\"p\", \"q\"]\n[algebroid]\nkind = \"tangent\"\n[control]\n" +
           control;
}

} // namespace

TEST_CASE("what the reference problems conserve is proved, and what they do not is refuted")
{
    std::size_t claims = 0;
    for (const ReferenceCase& control : read_control_cases()) {
        INFO(control.name);
        const json::Value file =
            json::read_file(std::string(LAGEN_SOURCE_DIR) + "/tests/data/bvp/" + control.name + ".json");
        std::vector<std::string> texts = {"hamiltonian", "energy"};
        for (const json::Value& invariant : file["invariants"].entries) texts.push_back(invariant["expr"].text);
        std::string expected;
        for (std::size_t k = 0; k < texts.size(); ++k) expected += "proved, ";
        texts.push_back(control.base.at(0));
        CHECK(statuses(model_text(control), texts) == expected + "refuted");
        claims += texts.size();
    }
    CHECK(claims > 30);
}

TEST_CASE("controls in a claim are those of the extremal")
{
    // H = p u + q x - u^2/2: u = p, p' = -q, q' = 0
    const std::string problem =
        controlled_plane("controls = [\"u\"]\nsigma = { a = \"u\", b = \"x\" }\ncost = \"u^2/2\"\n");
    CHECK(statuses(problem, {"u - p", "u + q*t", "u", "a - u", "b - x", "lagrangian - u^2/2", "energy"}) ==
          "proved, proved, refuted, proved, proved, proved, proved");
}

TEST_CASE("coupled controls are solved for together")
{
    const std::string problem = controlled_plane("controls = [\"u[1..2]\"]\nsigma = { a = \"u[1]\", b = \"u[2]\" }\n"
                                                 "cost = \"u[1]^2 + u[1]*u[2] + u[2]^2 + k*u[1]\"\n");
    // p = 2 u1 + u2 + k, q = u1 + 2 u2
    CHECK(statuses(problem, {"3*u[1] - 2*p + q + 2*k", "3*u[2] - 2*q + p - k", "x - u[1]*t", "x"}) ==
          "proved, proved, proved, refuted");
}

TEST_CASE("a cost of time leaves the Hamiltonian no invariant")
{
    const std::string problem =
        controlled_plane("controls = [\"u\"]\nsigma = { a = \"u\" }\ncost = \"u^2/2 + x^2*cos(t)\"\n");
    CHECK(statuses(problem, {"hamiltonian", "q"}) == "refuted, proved");
}

TEST_CASE("with bounded controls only what holds for every control is proved, and nothing is refuted")
{
    const std::string problem = controlled_plane(
        "controls = [\"u\"]\nsigma = { a = \"u\", b = \"x\" }\ncost = \"u^2/2\"\nbounds = { u = [-1, 1] }\n");
    const std::vector<std::string> claims = {"q", "p + q*t", "hamiltonian", "x", "u", "p"};
    CHECK(statuses(problem, claims) == "proved, proved, proved, undecided, undecided, refuted");
    CHECK(first_obstacle(problem, claims) ==
          "the controls are bounded, so that they are no smooth functions of x and mu");
}

TEST_CASE("controls that are not solved for leave a claim undecided, with the reason")
{
    CHECK(first_obstacle(controlled_plane("controls = [\"u\"]\nsigma = { a = \"u\" }\ncost = \"u^4/4\"\n"), {"x"}) ==
          "dH/du is not affine in the controls, which are not solved for then");
    CHECK(first_obstacle(
              controlled_plane("controls = [\"u\", \"w\"]\nsigma = { a = \"u\", b = \"w\" }\ncost = \"(u + w)^2\"\n"),
              {"x"}) == "d2H/du2 is singular, so that dH/du = 0 does not determine the controls");
}

TEST_CASE("sigma and cost count where they are defined, and may divide by nothing that is zero everywhere")
{
    const std::string control = "controls = [\"u\"]\nsigma = { a = \"u\" }\ncost = \"u^2/2 + log(-1 - x^2)\"\n";
    CHECK(verified_text(controlled_plane(control)).structure.verdict == Verdict::undecided);
    CHECK_THROWS_WITH(
        verified_text(controlled_plane(
            "controls = [\"u\"]\nsigma = { a = \"u/(u*(sin(x)^2 + cos(x)^2) - u)\" }\ncost = \"u^2/2\"\n")),
        Catch::Contains("division by u*(sin(x)^2 + cos(x)^2) - u, which is zero everywhere"));
}
