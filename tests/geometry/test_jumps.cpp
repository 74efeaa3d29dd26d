// SPDX-License-Identifier: GPL-2.0-or-later
/// atan2(v, u) jumps by 2*pi across v = 0, u < 0, which its derivatives do not show: what contains it is no proved
/// invariant, Casimir or constraint unless the domain keeps off the cut.
#include "geometry/claim_statuses.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

/// Points (x, y, phi) that turn about the origin as phi grows; `base` and `more` are lines of [base] and blocks.
std::string turning(const std::string& base, const std::string& more = "")
{
    return "[base]\ncoordinates = [\"x\", \"y\", \"phi\"]\n" + base +
           "[fibre]\ncoordinates = [\"a\"]\n[algebroid]\nkind = \"general\"\n[algebroid.anchor]\n"
           "a = { x = \"-y\", y = \"x\", phi = \"1\" }\n" +
           more;
}

/// A particle in the plane with the potential U.
std::string jumping_plane(const std::string& potential, const std::string& base = "", const std::string& more = "")
{
    return "[base]\ncoordinates = [\"x\", \"y\"]\n" + base +
           "[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"(v_x^2 + v_y^2)/2 - (" + potential + ")\"\n" + more;
}

const std::string jump = "its rate vanishes, but atan2(y, x) jumps by 2*pi where y changes its sign and x < 0";

/// The statuses of the checks of this name, in their order.
std::string status_of(const VerifiedAlgebroid& verified, const std::string& name)
{
    std::string found;
    for (const Check& check : verified.checks)
        if (check.name == name) found += (found.empty() ? "" : " ") + std::string(to_text(check.decision.status));
    return found;
}

} // namespace

TEST_CASE("the angle of a point that turns is not phi: their difference jumps at half a turn")
{
    // x = cos t, y = sin t, phi = t is a motion with a = 1.
    const auto difference = [](double t) { return t - std::atan2(std::sin(t), std::cos(t)); };
    CHECK_THAT(difference(3.1), Catch::WithinAbs(0, 1e-14));
    CHECK_THAT(difference(3.2), Catch::WithinAbs(2 * std::acos(-1.0), 1e-14));
    CHECK(statuses(turning(""), {"phi - atan2(y, x)"}) == "undecided");
    CHECK(first_obstacle(turning(""), {"phi - atan2(y, x)"}) == jump);
}

TEST_CASE("a domain helps where it keeps off the cut of atan2, not where it meets it")
{
    const std::vector<std::string> claim{"phi - atan2(y, x)"};
    for (const char* meets : {"domain = [\"x^2 + y^2 > 0\"]\n", "domain = [\"x < -1\"]\n", "domain = [\"x > -1\"]\n",
                              "domain = [\"y > -1\"]\n"}) {
        CAPTURE(meets);
        CHECK(first_obstacle(turning(meets), claim) == jump);
    }
    for (const char* keeps_off : {"domain = [\"x > 0\"]\n", "domain = [\"y > 0\"]\n", "domain = [\"y < 0\"]\n",
                                  "domain = [\"x - y^2 > 0\"]\n"}) {
        CAPTURE(keeps_off);
        CHECK(statuses(turning(keeps_off), claim) == "proved");
    }
}

TEST_CASE("atan2 jumps through definitions and inside of other functions too")
{
    const std::string defined =
        turning("", "[definitions]\nangle = \"atan2(y, x)\"\ntwice = \"2*angle\"\n[invariants]\nJ = \"2*phi - twice\"\n"
                    "K = \"exp(phi - angle)\"\n");
    CHECK(statuses(defined, {}) == "undecided undecided");
    CHECK(first_obstacle(defined, {}) == jump);
    const std::string inside = turning("domain = [\"x > 0\"]\n", "[definitions]\nangle = \"atan2(y, x)\"\n"
                                                                 "[invariants]\nJ = \"phi - angle\"\n");
    CHECK(statuses(inside, {}) == "proved");
}

TEST_CASE("a claim that is wrong is refuted, with atan2 or without")
{
    CHECK(statuses(turning(""), {"phi + atan2(y, x)", "phi - 2*atan2(y, x)"}) == "refuted refuted");
}

TEST_CASE("a Casimir with atan2 is one where the domain keeps off its cut")
{
    const std::string casimir = "casimirs = { turns = \"phi - atan2(y, x)\" }\n";
    const VerifiedAlgebroid open = verified_text(turning(casimir));
    CHECK(open.verdict == Verdict::undecided);
    CHECK(status_of(open, "casimir") == "undecided");
    CHECK(first_obstacle(turning(casimir), {}) == jump);
    const VerifiedAlgebroid half = verified_text(turning(casimir + "domain = [\"x > 0\"]\n"));
    CHECK(half.verdict == Verdict::valid);
    CHECK(status_of(half, "casimir") == "proved");
}

TEST_CASE("a constraint with atan2 is kept by the anchor where the domain keeps off its cut")
{
    const std::string spiral = "constraints = [\"phi - atan2(y, x)\"]\n";
    const VerifiedAlgebroid open = verified_text(turning(spiral));
    CHECK(open.verdict == Verdict::undecided);
    CHECK(status_of(open, "tangency") == "undecided");
    CHECK(first_obstacle(turning(spiral), {}) == jump);
    const VerifiedAlgebroid half = verified_text(turning(spiral + "domain = [\"y > 0\"]\n"));
    CHECK(half.verdict == Verdict::valid);
    CHECK(status_of(half, "tangency") == "proved");
}

TEST_CASE("the energy in a potential that jumps is conserved only off the jump")
{
    CHECK(statuses(jumping_plane("atan2(y, x)"), {"energy"}) == "undecided");
    CHECK(first_obstacle(jumping_plane("atan2(y, x)"), {"energy"}) == jump);
    CHECK(statuses(jumping_plane("atan2(y, x)", "domain = [\"x > 0\"]\n"), {"energy"}) == "proved");
    CHECK(statuses(jumping_plane("atan2(y, x)^2"), {"energy", "v_x"}) == "undecided refuted");
}

TEST_CASE("a direction of velocities or momenta jumps too, and the message names the coordinates of the state")
{
    CHECK(first_obstacle(jumping_plane("0"), {"atan2(v_y, v_x)"}) ==
          "its rate vanishes, but atan2(v_y, v_x) jumps by 2*pi where v_y changes its sign and v_x < 0");
    const std::string hidden = jumping_plane("0", "", "[observables]\nheading = \"atan2(p_v_y, p_v_x)\"\n");
    CHECK(first_obstacle(hidden, {"atan2(p_v_y, p_v_x)"}) ==
          "its rate vanishes, but atan2(v_y, v_x) jumps by 2*pi where v_y changes its sign and v_x < 0");
}

TEST_CASE("atan2 jumps along Hamilton's equations as along Lagrange's")
{
    const std::string free = "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\nmomenta = "
                             "[\"p\", \"q\"]\n[algebroid]\nkind = \"tangent\"\n[hamiltonian]\nH = \"(p^2 + q^2)/2\"\n";
    CHECK(statuses(free, {"atan2(q, p)", "atan2(v, u)", "atan2(v, p) + x"}) == "undecided undecided refuted");
    CHECK(first_obstacle(free, {"atan2(v, u)"}) ==
          "its rate vanishes, but atan2(q, p) jumps by 2*pi where q changes its sign and p < 0");
}
