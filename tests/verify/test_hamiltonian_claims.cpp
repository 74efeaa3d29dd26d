// SPDX-License-Identifier: GPL-2.0-or-later
/// Checks of models with a Hamiltonian: invariants along Hamilton's equations, regularity of d2H/dmu2, and whether H is
/// the Legendre transform of L where both are given.
#include "verify/algebroid_texts.hpp"
#include "verify/claim_statuses.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

std::string hamiltonian_plane(const std::string& hamiltonian, const std::string& more = "")
{
    return "[parameters]\nk = 1\n[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\nmomenta "
           "= "
           "[\"p\", \"q\"]\n[algebroid]\nkind = \"tangent\"\n[hamiltonian]\nH = \"" +
           hamiltonian + "\"\n" + more;
}

const std::string heavy_top_momenta = "[parameters]\nI1 = 1\nI3 = 3\nmgl = 5\n" +
                                      turning_vector(on_sphere, "momenta = [\"m1\", \"m2\", \"m3\"]\n") +
                                      "[hamiltonian]\nH = \"(m1^2/I1 + m2^2/I1 + m3^2/I3)/2 + mgl*g3\"\n";

const Check& legendre_of(const Report& verified)
{
    for (const Check& check : verified.structure.checks)
        if (check.name == "legendre") return check;
    throw std::runtime_error("no check 'legendre'");
}

} // namespace

TEST_CASE("Kepler's problem in momenta conserves angular momentum and the Laplace vector")
{
    CHECK(statuses(hamiltonian_plane("(p^2 + q^2)/2 - k/sqrt(x^2 + y^2)"),
                   {"x*q - y*p", "q*(x*q - y*p) - k*x/sqrt(x^2 + y^2)", "q*(x*q - y*p) + k*x/sqrt(x^2 + y^2)", "energy",
                    "hamiltonian", "lagrangian"}) ==
          "proved, proved where x^2 + y^2 != 0, refuted, proved where x^2 + y^2 != 0, proved where x^2 + y^2 != 0, "
          "refuted");
}

TEST_CASE("fibre coordinates in a claim are dH/dmu")
{
    // H = p^2/2 + p q + q^2: u = p + q, v = p + 2 q
    CHECK(
        statuses(hamiltonian_plane("p^2/2 + p*q + q^2"), {"u", "v", "u - p - q", "u*x", "lagrangian - hamiltonian"}) ==
        "proved, proved, proved, refuted, proved");
    CHECK(statuses(hamiltonian_plane("sqrt(1 + p^2 + q^2)"), {"u^2 + v^2", "u*q - v*p", "x - u*t", "x + u*t"}) ==
          "proved, proved, proved, refuted");
}

TEST_CASE("Lagrange's top in momenta conserves m.g, m3 and the energy, but not m1")
{
    CHECK(statuses(heavy_top_momenta, {"m1*g1 + m2*g2 + m3*g3", "m3", "energy", "w3", "m1", "g1^2 + g2^2 + g3^2"}) ==
          "proved, proved, proved, proved, refuted, proved");
}

TEST_CASE("a Hamiltonian of time does not conserve itself, and forces act over y = dH/dmu")
{
    CHECK(statuses(hamiltonian_plane("(p^2 + q^2)/2 + x*sin(t)"), {"energy", "q"}) == "refuted, proved");
    CHECK(statuses(hamiltonian_plane("p^2 + q^2/2", "[forces]\nu = \"-u\"\n[dissipation]\nR = \"v^2/2\"\n"),
                   {"p + x", "q + y", "p*exp(2*t)", "q*exp(t)", "energy"}) ==
          "proved, proved, proved, proved, refuted");
    CHECK(statuses(hamiltonian_plane("p^2 + q^2/2", "[forces]\nu = \"v\"\nv = \"-u\"\n"), {"energy"}) == "proved");
}

TEST_CASE("without a Lagrangian the regularity is that of d2H/dmu2")
{
    const Regularity regular = verified_text(heavy_top_momenta).mechanics.regularity;
    CHECK(regular.of == Regularity::Matrix::hamiltonian);
    CHECK(regular.kind == Regularity::Kind::regular);
    CHECK(regular.rank == 3);
    const Regularity degenerate = verified_text(hamiltonian_plane("p^2/2 + x*q")).mechanics.regularity;
    CHECK(degenerate.kind == Regularity::Kind::degenerate);
    CHECK(degenerate.rank == 1);
    CHECK(
        verified_text(hamiltonian_plane("p^2/2 + q^2", "[lagrangian]\nL = \"u^2 + v^2\"\n")).mechanics.regularity.of ==
        Regularity::Matrix::lagrangian);
}

TEST_CASE("H is proved to be the Legendre transform of L, or refuted at a point")
{
    const std::string right = hamiltonian_plane("p^2/(2*(2 + cos(x))) + q^2/2 + k*x^2/2",
                                                "[lagrangian]\nL = \"((2 + cos(x))*u^2 + v^2 - k*x^2)/2\"\n");
    CHECK(legendre_of(verified_text(right)).decision.status == ProofStatus::proved);
    const std::string wrong =
        hamiltonian_plane("p^2/2 + q^2/2 - k*x^2/2", "[lagrangian]\nL = \"(u^2 + v^2 - k*x^2)/2\"\n");
    const ModelReport verified = verified_text(wrong);
    const Check& check = legendre_of(verified);
    CHECK(verified.structure.verdict == Verdict::invalid);
    CHECK(check.decision.residual == "-k*x^2");
    REQUIRE(check.decision.witness);
    CHECK(check.decision.witness->value != 0);
    CHECK(check.hint == "H is y^a dL/dy^a - L at mu_a = dL/dy^a; leave [hamiltonian] out, and it is found from L");
}

TEST_CASE("a Legendre transform that only algebra sees is proved: the relativistic particle")
{
    const std::string model = hamiltonian_plane("sqrt(1 + p^2)", "[lagrangian]\nL = \"-sqrt(1 - u^2)\"\n");
    CHECK(legendre_of(verified_text(model)).decision.status == ProofStatus::proved);
}

TEST_CASE("H counts where it is defined, and may divide by nothing that is zero everywhere")
{
    CHECK(verified_text(hamiltonian_plane("log(-1 - p^2)")).structure.verdict == Verdict::undecided);
    CHECK(verified_text(hamiltonian_plane("log(1 + p^2)")).structure.verdict == Verdict::valid);
    CHECK_THROWS_WITH(verified_text(hamiltonian_plane("p/(q - q*(sin(x)^2 + cos(x)^2))")),
                      Catch::Contains("which is zero everywhere"));
}
