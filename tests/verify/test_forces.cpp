// SPDX-License-Identifier: GPL-2.0-or-later
/// Conserved quantities under forces and dissipation: d/dt p_a gains Q_a, dE/dt gains Q_a y^a.
#include "verify/claim_statuses.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

std::string forced_plane(const std::string& blocks,
                         const std::string& lagrangian = "(m*(v_x^2 + v_y^2) - k*(x^2 + y^2))/2")
{
    return "[parameters]\nm = 2\nk = 3\nc = \"1/5\"\n[base]\ncoordinates = [\"x\", \"y\"]\ndomain = [\"m > 0\", \"c > "
           "0\"]\n"
           "[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"" +
           lagrangian + "\"\n" + blocks;
}

} // namespace

TEST_CASE("friction takes energy away, a gyroscopic force does not")
{
    CHECK(statuses(forced_plane("[dissipation]\nR = \"c*(v_x^2 + v_y^2)/2\"\n"), {"energy"}) == "refuted");
    CHECK(statuses(forced_plane("[forces]\nv_x = \"-c*v_y\"\nv_y = \"c*v_x\"\n"),
                   {"energy", "hamiltonian", "lagrangian"}) == "proved, proved, refuted");
    CHECK(statuses(forced_plane("[forces]\nv_x = \"-c*v_y\"\nv_y = \"2*c*v_x\"\n"), {"energy"}) == "refuted");
}

TEST_CASE("a force and the dissipation that takes as much leave the energy as it is")
{
    const std::string balanced = "[forces]\nv_x = \"c*v_x^3\"\n[dissipation]\nR = \"c*v_x^4/4\"\n";
    CHECK(statuses(forced_plane(balanced), {"energy", "p_v_x"}) == "proved, refuted");
}

TEST_CASE("momenta of a free particle in friction, in wind and in a pulsating field follow their integrals")
{
    const std::string free = "m*(v_x^2 + v_y^2)/2";
    CHECK(statuses(forced_plane("[dissipation]\nR = \"c*v_x^2/2\"\n", free),
                   {"v_x*exp(c*t/m)", "p_v_x + c*x", "v_x*exp(2*c*t/m)", "v_y"}) == "proved, proved, refuted, proved");
    CHECK(statuses(forced_plane("[forces]\nv_x = 1\nv_y = \"cos(t)\"\n", free),
                   {"p_v_x - t", "p_v_y - sin(t)", "energy - x", "energy"}) == "proved, proved, refuted, refuted");
}

TEST_CASE("forces on a rigid body act along its momenta: a torque along Pi leaves its direction")
{
    const std::string body = R"toml(
[fibre]
coordinates = ["w1", "w2", "w3"]
[algebroid]
kind = "lie_algebra"
algebra = "so(3)"
[lagrangian]
L = "(w1^2 + 2*w2^2 + 3*w3^2)/2"
[forces]
w1 = "-p1"
w2 = "-p2"
w3 = "-p3"
[definitions]
p1 = "w1"
p2 = "2*w2"
p3 = "3*w3"
)toml";
    CHECK(statuses(body, {"(p1^2 + p2^2 + p3^2)*exp(2*t)", "energy*exp(2*t)", "p1^2 + p2^2 + p3^2"}) ==
          "proved, proved, refuted");
}

TEST_CASE("a force that switches is followed along: what it does not touch is proved")
{
    const std::string wall = "[forces]\nv_x = \"if(x < 0, -k*x, 0)\"\n";
    CHECK(statuses(forced_plane(wall, "m*(v_x^2 + v_y^2)/2"), {"p_v_y", "energy"}) == "proved, refuted");
}

TEST_CASE("forces and dissipation count where they are defined, and may divide by nothing that is zero everywhere")
{
    const ModelReport nowhere = verified_text(forced_plane("[forces]\nv_x = \"log(-1 - x^2)\"\n"));
    CHECK(nowhere.structure.verdict == Verdict::undecided);
    CHECK(nowhere.structure.note ==
          "no point was found where everything in the model is defined and every condition of [base] "
          "holds");
    CHECK(verified_text(forced_plane("[forces]\nv_x = \"log(1 + x^2)\"\n")).structure.note.empty());
    CHECK_THROWS_WITH(verified_text(forced_plane("[dissipation]\nR = \"v_x^2/(sin(x)^2 + cos(x)^2 - 1)\"\n")),
                      Catch::Contains("division by sin(x)^2 + cos(x)^2 - 1, which is zero everywhere"));
}
