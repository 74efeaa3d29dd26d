// SPDX-License-Identifier: GPL-2.0-or-later
/// Candidates of Hamilton and Jacobi's equation: closed, constant on leaves, and whether their integral curves lift,
/// each by itself, against cases whose truth was found elsewhere.
#include "support/json.hpp"
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

using namespace lagen;
using Names = std::vector<std::string>;

namespace {

const std::string is_so = "proved", fails = "refuted", unknown = "undecided";

/// closed, constant on leaves, lifts
Names candidate_statuses(const std::string& text)
{
    const Report report = verified_text(text);
    REQUIRE(report.structure.hamilton_jacobi);
    const HamiltonJacobiReport& candidate = *report.structure.hamilton_jacobi;
    return {to_text(candidate.closed), to_text(candidate.equation), to_text(candidate.lifts)};
}

const std::string moving_plane =
    "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\n"
    "kind = \"tangent\"\n";

std::string candidate_text(const json::Value& test)
{
    std::string text = "[base]\ncoordinates = [";
    std::string fibre, rho, alpha;
    for (std::size_t i = 0; i < test["base"].size(); ++i)
        text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", test["base"][i].text);
    text += "]\ndomain = [";
    std::string bounds;
    const json::Value& domain = test["domain"];
    for (std::size_t k = 0; k < domain.size(); ++k)
        for (std::size_t end = 0; end < 2; ++end)
            bounds += fmt::format("{}\"{} {} {}\"", bounds.empty() ? "" : ", ", domain.keys[k], end == 0 ? ">" : "<",
                                  domain[k][end].text);
    text += bounds + "]\n[parameters]\n";
    for (const std::string& parameter : test["parameters"].texts()) text += parameter + " = \"3/2\"\n";
    const auto r = test["alpha"].size();
    for (std::size_t a = 0; a < r; ++a) {
        fibre += fmt::format("{}\"y{}\"", a == 0 ? "" : ", ", a + 1);
        rho += fmt::format("y{} = {{ {} = \"1\" }}\n", a + 1, test["base"][a].text);
        alpha += fmt::format("{}y{} = \"{}\"", a == 0 ? "" : ", ", a + 1, test["alpha"][a].text);
    }
    text += "[fibre]\ncoordinates = [" + fibre + "]\nmomenta = [";
    for (std::size_t a = 0; a < r; ++a) text += fmt::format("{}\"mu{}\"", a == 0 ? "" : ", ", a + 1);
    return text + "]\n[algebroid.anchor]\n" + rho + "[hamiltonian]\nH = \"" + test["hamiltonian"].text +
           "\"\n[hamilton_jacobi]\nalpha = { " + alpha + " }\n";
}

} // namespace

TEST_CASE("candidates of Hamilton and Jacobi's equation have the verdicts of the reference")
{
    const json::Value file = json::read_file(LAGEN_SOURCE_DIR "/tests/data/definitions/hamilton_jacobi.json");
    REQUIRE(file.size() == 3);
    for (const json::Value& test : file.entries) {
        INFO(test["id"].text);
        const auto wanted = [&](const char* name) { return test["truth"][name].text == "true" ? is_so : fails; };
        CHECK(candidate_statuses(candidate_text(test)) ==
              Names{wanted("closed"), wanted("d_H_alpha_zero"), wanted("graph_invariant")});
    }
}

TEST_CASE("S is a candidate by its differential, of H and of the transform of L")
{
    const std::string oscillator =
        "[parameters]\nE = 2\n[base]\ncoordinates = [\"q\"]\ndomain = [\"q > -1\", \"q < 1\", "
        "\"E > 1\"]\n[fibre]\ncoordinates = [\"v\"]\n[algebroid]\nkind = \"tangent\"\n";
    const std::string S = "[hamilton_jacobi]\nS = \"q*sqrt(2*E - q^2)/2 + E*asin(q/sqrt(2*E))\"\n";
    CHECK(candidate_statuses(oscillator + "[hamiltonian]\nH = \"(p_v^2 + q^2)/2\"\n" + S) ==
          Names{is_so, is_so, is_so});
    CHECK(candidate_statuses(oscillator + "[lagrangian]\nL = \"(v^2 - q^2)/2\"\n" + S) == Names{is_so, is_so, is_so});
    CHECK(candidate_statuses(oscillator + "[lagrangian]\nL = \"v^2 - q^2/2\"\n" + S) == Names{is_so, fails, fails});
    const Report refuted = verified_text(oscillator + "[lagrangian]\nL = \"v^2 - q^2/2\"\n" + S);
    CHECK(refuted.structure.verdict == Verdict::invalid);
    const Check& check = refuted.structure.checks.back();
    CHECK(check.name == "hamilton_jacobi");
    CHECK(check.indices == Names{"v"});
    REQUIRE(check.decision.witness);
}

TEST_CASE("without closedness neither condition follows from the other")
{
    // alpha = (f(y), 0): the graph is invariant under the free motion, and H o alpha varies.
    CHECK(
        candidate_statuses(moving_plane +
                           "[hamiltonian]\nH = \"(p_u^2 + p_v^2)/2\"\n[hamilton_jacobi]\nalpha = { u = \"y^3\" }\n") ==
        Names{fails, fails, is_so});
    // H o alpha = 0, and the graph is not invariant.
    CHECK(candidate_statuses(moving_plane +
                             "[hamiltonian]\nH = \"(p_u^2 + p_v^2)/2 - (x^2 + y^2)/2\"\n[hamilton_jacobi]\n"
                             "alpha = { u = \"y\", v = \"-x\" }\n") == Names{fails, is_so, fails});
}

TEST_CASE("a closed section that is no differential is a candidate, and H o alpha need be constant on leaves alone")
{
    // aff(1) over a point: e^1 is closed, and every differential is 0.
    const std::string affine = "[parameters]\nc = 3\n[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\nkind = "
                               "\"lie_algebra\"\nalgebra = \"aff(1)\"\n[lagrangian]\nL = \"(a^2 + b^2)/2\"\n";
    CHECK(candidate_statuses(affine + "[hamilton_jacobi]\nalpha = { a = \"c\" }\n") == Names{is_so, is_so, is_so});
    CHECK(candidate_statuses(affine + "[hamilton_jacobi]\nalpha = { b = \"c\" }\n") == Names{fails, is_so, fails});
    // y does not move: H o alpha = f(y)^2/2 is constant on each leaf.
    const std::string leaves =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\"]\n[algebroid]\nkind = "
        "\"tangent\"\nover = [\"x\"]\n[lagrangian]\nL = \"u^2/2\"\n";
    CHECK(candidate_statuses(leaves + "[hamilton_jacobi]\nalpha = { u = \"sin(y)\" }\n") == Names{is_so, is_so, is_so});
    CHECK(candidate_statuses(leaves + "[hamilton_jacobi]\nalpha = { u = \"sin(x)\" }\n") == Names{is_so, fails, fails});
}

TEST_CASE("a candidate that jumps says where it holds")
{
    for (const char* candidate : {"alpha = { u = \"2 + abs(x)/x\" }\n", "S = \"2*x + abs(x)\"\n"}) {
        INFO(candidate);
        const Report report =
            verified_text(moving_plane + "[lagrangian]\nL = \"(u^2 + v^2)/2\"\n[hamilton_jacobi]\n" + candidate);
        CHECK(report.structure.verdict == Verdict::valid);
        REQUIRE(!report.structure.checks.empty());
        CHECK(report.structure.checks.back().where == std::vector<std::string>{"x != 0"});
    }
}

TEST_CASE("forces push the momenta off the graph, and an L without closed velocities is undecided")
{
    const std::string free = moving_plane + "[lagrangian]\nL = \"(u^2 + v^2)/2\"\n[forces]\nu = \"-u\"\n";
    CHECK(candidate_statuses(free + "[hamilton_jacobi]\nalpha = { u = 1 }\n") == Names{is_so, is_so, fails});
    CHECK(candidate_statuses(moving_plane +
                             "[lagrangian]\nL = \"cosh(u) + v^4\"\n[hamilton_jacobi]\nalpha = { u = 1 }\n") ==
          Names{unknown, unknown, unknown});
    CHECK(candidate_statuses(moving_plane + "[lagrangian]\nL = \"u^2/2\"\n[hamilton_jacobi]\nalpha = { u = 1 }\n") ==
          Names{unknown, unknown, unknown});
}

TEST_CASE("the action along lifted curves is the integral of alpha, of an L that belongs to H")
{
    const auto action_of = [](const std::string& text) {
        const Report report = verified_text(text);
        const auto& candidate = report.structure.hamilton_jacobi;
        return std::string(candidate && candidate->action ? to_text(*candidate->action) : "absent");
    };
    const std::string free = moving_plane + "[hamilton_jacobi]\nalpha = { u = \"x*y\", v = 2 }\n";
    const std::string L = "[lagrangian]\nL = \"(u^2 + v^2)/2 + x*v - y^3\"\n";
    CHECK(action_of(free + L) == is_so); // whether alpha is closed does not matter
    CHECK(action_of(free + L + "[forces]\nu = \"-u\"\n") == is_so);
    CHECK(action_of(free + "[hamiltonian]\nH = \"(p_u^2 + (p_v - x)^2)/2 + y^3\"\n") == "absent");
    CHECK(action_of(free + L + "[hamiltonian]\nH = \"(p_u^2 + (p_v - x)^2)/2 + y^3 + 1\"\n") == fails);
}

TEST_CASE("a refuted candidate has a residual without powers of roots below the line")
{
    const Report refuted = verified_text(R"toml(
[parameters]
k = 1
[base]
coordinates = ["xi", "eta"]
domain = ["xi > 0", "eta > 0"]
[fibre]
coordinates = ["u", "v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(xi + eta)*(u^2/xi + v^2/eta)/8 + 2*k/(xi + eta)"
[hamilton_jacobi]
S = "2*sqrt(k*xi) + 2*sqrt(k*eta)"
)toml");
    const Check& check = refuted.structure.checks.back();
    REQUIRE(check.decision.status == ProofStatus::refuted);
    CHECK(check.decision.residual == "-2*k/(xi + eta)^2");
}
