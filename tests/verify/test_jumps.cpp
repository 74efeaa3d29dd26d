// SPDX-License-Identifier: GPL-2.0-or-later
/// atan2(v, u) jumps by 2*pi across v = 0, u < 0, and abs(x)/x across x = 0, which their derivatives do not show: what
/// contains them is no proved invariant, Casimir or constraint unless the domain keeps off.
#include "verify/claim_statuses.hpp"

#include <catch2/catch.hpp>

#include <chrono>
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

/// A particle on the line with the potential U.
std::string on_line(const std::string& potential, const std::string& base = "")
{
    return "[base]\ncoordinates = [\"x\"]\n" + base +
           "[fibre]\ncoordinates = [\"v\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"v^2/2 - (" +
           potential + ")\"\n";
}

/// The statuses of the checks of this name, in their order.
std::string status_of(const Report& verified, const std::string& name)
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
    const ModelReport open = verified_text(turning(casimir));
    CHECK(open.verdict == Verdict::undecided);
    CHECK(status_of(open, "casimir") == "undecided");
    CHECK(first_obstacle(turning(casimir), {}) == jump);
    const ModelReport half = verified_text(turning(casimir + "domain = [\"x > 0\"]\n"));
    CHECK(half.verdict == Verdict::valid);
    CHECK(status_of(half, "casimir") == "proved");
}

TEST_CASE("a constraint with atan2 is kept by the anchor where the domain keeps off its cut")
{
    const std::string spiral = "constraints = [\"phi - atan2(y, x)\"]\n";
    const ModelReport open = verified_text(turning(spiral));
    CHECK(open.verdict == Verdict::undecided);
    CHECK(status_of(open, "tangency") == "undecided");
    CHECK(first_obstacle(turning(spiral), {}) == jump);
    const ModelReport half = verified_text(turning(spiral + "domain = [\"y > 0\"]\n"));
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
    // The velocity turns once in 2 pi.
    const std::string magnetic = "(v_x*y - x*v_y)/2";
    CHECK(first_obstacle(jumping_plane(magnetic), {"atan2(v_y, v_x) + t"}) ==
          "its rate vanishes, but atan2(v_y, v_x) jumps by 2*pi where v_y changes its sign and v_x < 0");
    const std::string hidden = jumping_plane(magnetic, "", "[observables]\nheading = \"atan2(p_v_y, p_v_x)\"\n");
    CHECK(first_obstacle(hidden, {"atan2(p_v_y - x/2, p_v_x + y/2) + t"})
              .starts_with(
                  "its rate vanishes, but atan2(1/2*x + v_y - x/2, v_x - 1/2*y + y/2) jumps by 2*pi where 1/2*x"));
}

TEST_CASE("atan2 jumps along Hamilton's equations as along Lagrange's")
{
    const std::string magnetic =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\nmomenta = "
        "[\"p\", \"q\"]\n[algebroid]\nkind = \"tangent\"\n[hamiltonian]\nH = \"((p + y/2)^2 + (q - "
        "x/2)^2)/2\"\n";
    CHECK(statuses(magnetic, {"atan2(v, u) + t", "atan2(v, u) - t", "atan2(v, p) + t"}) == "undecided refuted refuted");
    CHECK(
        first_obstacle(magnetic, {"atan2(v, u) + t"}) ==
        "its rate vanishes, but atan2(q - x/2, p + y/2) jumps by 2*pi where q - x/2 changes its sign and p + y/2 < 0");
}

TEST_CASE("functions of conserved functions are conserved, whatever they are")
{
    CHECK(statuses(jumping_plane("0"), {"atan2(v_y, v_x)", "atan2(p_v_y, p_v_x)", "v_x/sqrt(v_x^2 + v_y^2)",
                                        "abs(v_x)/v_x", "atan(1/(x*v_y - y*v_x))", "atan2(v_y, v_x) + abs(x)/x"}) ==
          "proved proved proved proved proved undecided");
    const std::string kepler = "[parameters]\nk = 2\n" + jumping_plane("-k/sqrt(x^2 + y^2)", "domain = [\"k > 0\"]\n");
    const std::string ex = "v_y*(x*v_y - y*v_x) - k*x/sqrt(x^2 + y^2)",
                      ey = "-v_x*(x*v_y - y*v_x) - k*y/sqrt(x^2 + y^2)";
    CHECK(statuses(kepler, {"atan2(" + ey + ", " + ex + ")", "k/abs(2*energy)", "sqrt((" + ex + ")^2 + (" + ey + ")^2)",
                            "(-2*energy)^(3/2)/k"}) == "proved proved proved proved");
}

TEST_CASE("what depends on parameters alone does not move")
{
    const std::string spring =
        "[parameters]\nk = 2\nm = 3\n[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n"
        "[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"m*v^2/2 - k*x^2/2\"\n";
    CHECK(statuses(spring, {"x*cos(sqrt(k/m)*t) - v/sqrt(k/m)*sin(sqrt(k/m)*t)", "sqrt(v^2 + (k/m)*x^2)",
                            "energy/sqrt(k)", "log(energy/k)", "energy + abs(x)/x"}) ==
          "proved proved proved proved undecided");
}

TEST_CASE("what is constant on both sides of a hole only is not conserved")
{
    // x = t of the free particle: each of these has another value at t = -1 than at t = 1.
    const std::pair<const char*, const char*> claims[] = {
        {"abs(x)/x", "abs(x)/x may jump where x vanishes"},
        {"sqrt(x^2)/x", "abs(x)/x may jump where x vanishes"},
        {"x/sqrt(x^2)", "x/abs(x) may jump where abs(x) vanishes"},
        {"x^3*abs(x)^(-3)", "abs(x)^-3 may jump where abs(x) vanishes"},
        {"atan(1/x) + atan(x)", "atan(1/x) may jump where x vanishes"},
        {"tanh(x^(-1))*0 + atan(x^(-3)) + atan(x^3)", "atan(x^-3) may jump where x vanishes"},
        {"x*exp(-log(x^2)/2)", "exp(-log(x^2)/2) may jump where x^2 vanishes"},
        {"atan(1/log(x^2)) + atan(log(x^2))", "atan(1/log(x^2)) may jump where log(x^2) vanishes"},
        {"x - atan(tan(x))", "atan(tan(x)) may jump where cos(x) vanishes"},
        {"(v*abs(x)/x)^2*abs(x)/x", "v*abs(x)/x may jump where x vanishes"},
    };
    for (const auto& [claim, jumps] : claims) {
        CAPTURE(claim);
        CHECK(statuses(on_line("0"), {claim}) == "undecided");
        CHECK(first_obstacle(on_line("0"), {claim}) == std::string("its rate vanishes, but ") + jumps);
        CHECK(statuses(on_line("0", "domain = [\"x > 0\", \"x < 1\"]\n"), {claim}) == "proved");
    }
    // v does not move, but may be zero; so may the factor of a root in L.
    CHECK(statuses(on_line("0"), {"atan2(0, x)", "atan2(1, x) + atan(x)"}) == "undecided proved");
    CHECK(statuses("[parameters]\nc = 1\n" + on_line("x^2/2 - c*sqrt(1 - v^2)"), {"energy"}) == "undecided");
    CHECK(first_obstacle(on_line("0"), {"atan2(x, x^2) - atan(1/x)"}) ==
          "its rate vanishes, but atan2(x, x^2) may jump where x and x^2 vanish");
    CHECK(statuses(jumping_plane("0", "domain = [\"x*y > 0\"]\n"), {"abs(x*y)/(x*y)"}) == "proved");
}

TEST_CASE("the same constant goes on behind the poles of a quotient of analytic functions")
{
    CHECK(statuses(on_line("0"), {"(v*x^2 + v^2*x)/(x^2 + v*x)", "v*sin(x)*x^(-2)*x^2/sin(x)", "tan(x)*cos(x)/sin(x)*v",
                                  "sqrt(x^2) - abs(x) + x^2*v/(x*x + 0*v) - 1/x + v/(v*x)",
                                  "v*(abs(x) - sqrt(x^2) + tan(x) - sin(x)/cos(x))", "(exp(x) - 1)*v/(exp(x) - 1)"}) ==
          "proved proved proved proved proved proved");
    CHECK(statuses(on_line("0"), {"log(x^2) - 2*log(-x) + v*x/x^2*x", "v*log(x)/log(x)",
                                  "v + abs(x) - sqrt(x^2) + log(x^4)/log(x^2)"}) == "proved proved proved");
    // Behind a kink the motion is another one.
    CHECK(statuses(on_line("abs(x)"), {"energy", "energy*x*(x + v)/(x^2 + x*v)"}) == "proved undecided");
    CHECK(first_obstacle(on_line("abs(x)"), {"energy + v/(x + v) - v*(x + v)^(-1)"}) ==
          "its rate vanishes, but v/(x + v) may jump where x + v vanishes");
}

TEST_CASE("no motion meets the zeros of what its equations divide by as they are written, and of nothing else")
{
    const std::string kepler = jumping_plane("-1/sqrt(x^2 + y^2)");
    const std::string eccentricity = "v_y*(x*v_y - y*v_x) - x/sqrt(x^2 + y^2)";
    CHECK(statuses(kepler, {eccentricity, "atan(1/(x^2 + y^2)) + atan(x^2 + y^2) + energy"}) == "proved proved");
    const std::string spring = jumping_plane("(x^2 + y^2)/2");
    CHECK(statuses(spring, {"energy + atan(1/(x^2 + y^2)) + atan(x^2 + y^2)"}) == "undecided");
    const std::string side = "[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\nmomenta = [\"p\"]\n"
                             "[algebroid]\nkind = \"tangent\"\n";
    // H, L and forces that the default form has not.
    CHECK(statuses(side + "[lagrangian]\nL = \"v^2/2 - 1/x\"\n[control]\ncontrols = [\"u\"]\nsigma = { v = \"u\" }\n"
                          "cost = \"u^2/2\"\n",
                   {"p + abs(x)/x"}) == "undecided");
    CHECK(statuses(side + "[lagrangian]\nL = \"v^2/2\"\n[hamiltonian]\nH = \"p^2/2 + 1/x - 1/x\"\n", {"abs(x)/x"}) ==
          "undecided");
    // Derivatives of R, L and H that divide although the functions do not.
    CHECK(statuses(on_line("x") + "[dissipation]\nR = \"abs(v)^3/3\"\n", {"abs(v)/v"}) == "undecided");
    CHECK(statuses(on_line("-x - (v^2)^(3/2)/3"), {"abs(v)/v", "p_v - t + abs(v)/v"}) == "undecided undecided");
    CHECK(statuses(on_line("-x - v^2*sqrt(v^2)"), {"p_v - t + abs(v)/v"}) == "undecided");
    CHECK(statuses(side + "[hamiltonian]\nH = \"2/3*abs(p)^(3/2) - x\"\n", {"p - t + abs(p)/p"}) == "undecided");
    // A power with a parameter as exponent, which may be 2.
    CHECK(statuses("[parameters]\nn = 2\n" + on_line("x^n/2"), {"energy", "energy + abs(x)/x", "x - abs(x)"}) ==
          "proved undecided undecided");
}

TEST_CASE("no motion meets the zero of a root that would make its momentum infinite")
{
    CHECK(statuses(on_line("sqrt(1 - v^2) + x"), {"v^2/2 + 1/sqrt(1 - v^2) + x", "v + v/sqrt(1 - v^2) + t"}) ==
          "proved proved");
    CHECK(statuses(on_line("-x - 2*sqrt(4 - v^2)"), {"energy + atan(v/sqrt(4 - v^2)) - asin(v/2)"}) == "proved");
    // The momentum is finite, or the zeros of the root are no zeros of it alone.
    CHECK(statuses(on_line("-v*sqrt(v^2)/2 - x"), {"p_v - t + abs(v)/v"}) == "undecided");
}

TEST_CASE("Casimirs and constraints have no holes either")
{
    const std::string casimir = "casimirs = { side = \"x*abs(y)/(abs(y)*x) + abs(x)/x\" }\n";
    CHECK(status_of(verified_text(turning(casimir)), "casimir") == "undecided");
    CHECK(first_obstacle(turning(casimir), {}) == "its rate vanishes, but abs(x)/x may jump where x vanishes");
    CHECK(status_of(verified_text(turning("casimirs = { side = \"log(x^2) - 2*log(abs(x))\" }\n")), "casimir") ==
          "proved");
    // The anchor does not know what L divides by.
    CHECK(
        status_of(verified_text(turning("casimirs = { side = \"abs(y)/y\" }\n", "[lagrangian]\nL = \"a^2/2 - 1/y\"\n")),
                  "casimir") == "undecided");
}

TEST_CASE("terms that stand often in a Lagrangian are looked at once")
{
    const auto begin = std::chrono::steady_clock::now();
    const ModelReport verified =
        verified_text("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n[algebroid]\nkind = \"tangent\"\n"
                      "[lagrangian]\nL = \"v^2/2 + sum(i, 1, 10000, sum(j, 1, 10000, sum(k, 1, 10, x)))\"\n");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    CHECK(verified.verdict == Verdict::valid);
    CHECK(seconds.count() < 5);
}
