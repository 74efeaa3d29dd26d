// SPDX-License-Identifier: GPL-2.0-or-later
/// atan2(v, u) jumps by 2*pi across v = 0, u < 0, and abs(x)/x across x = 0, which their derivatives do not show: what
/// contains them is proved where no motion crosses that, and says where.
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
    for (const Check& check : verified.structure.checks)
        if (check.name == name) found += (found.empty() ? "" : ", ") + status_of(check);
    return found;
}

} // namespace

TEST_CASE("the angle of a point that turns is phi where the cut of atan2 is not crossed alone")
{
    // x = cos t, y = sin t, phi = t is a motion with a = 1.
    const auto difference = [](double t) { return t - std::atan2(std::sin(t), std::cos(t)); };
    CHECK_THAT(difference(3.1), Catch::WithinAbs(0, 1e-14));
    CHECK_THAT(difference(3.2), Catch::WithinAbs(2 * std::acos(-1.0), 1e-14));
    CHECK(statuses(turning(""), {"phi - atan2(y, x)"}) == "proved where y != 0");
}

TEST_CASE("a domain helps where it keeps off the cut of atan2, not where it meets it")
{
    const std::vector<std::string> claim{"phi - atan2(y, x)"};
    for (const char* meets : {"domain = [\"x^2 + y^2 > 0\"]\n", "domain = [\"x < -1\"]\n", "domain = [\"x > -1\"]\n",
                              "domain = [\"y > -1\"]\n"}) {
        CAPTURE(meets);
        CHECK(statuses(turning(meets), claim) == "proved where y != 0");
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
    CHECK(statuses(defined, {}) == "proved where y != 0, proved where y != 0");
    const std::string inside = turning("domain = [\"x > 0\"]\n", "[definitions]\nangle = \"atan2(y, x)\"\n"
                                                                 "[invariants]\nJ = \"phi - angle\"\n");
    CHECK(statuses(inside, {}) == "proved");
}

TEST_CASE("a claim that is wrong is refuted, with atan2 or without")
{
    CHECK(statuses(turning(""), {"phi + atan2(y, x)", "phi - 2*atan2(y, x)"}) == "refuted, refuted");
}

TEST_CASE("a Casimir with atan2 is one where the domain keeps off its cut, and else says where")
{
    const std::string casimir = "casimirs = { turns = \"phi - atan2(y, x)\" }\n";
    const ModelReport open = verified_text(turning(casimir));
    CHECK(open.structure.verdict == Verdict::valid);
    CHECK(status_of(open, "casimir") == "proved where y != 0");
    const ModelReport half = verified_text(turning(casimir + "domain = [\"x > 0\"]\n"));
    CHECK(half.structure.verdict == Verdict::valid);
    CHECK(status_of(half, "casimir") == "proved");
}

TEST_CASE("a constraint with atan2 is kept by the anchor off its cut")
{
    const std::string spiral = "constraints = [\"phi - atan2(y, x)\"]\n";
    CHECK(status_of(verified_text(turning(spiral)), "tangency") == "proved where y != 0");
    CHECK(status_of(verified_text(turning(spiral + "domain = [\"y > 0\"]\n")), "tangency") == "proved");
}

TEST_CASE("the energy in a potential that jumps is conserved off the jump")
{
    CHECK(statuses(jumping_plane("atan2(y, x)"), {"energy"}) == "proved where y != 0");
    CHECK(statuses(jumping_plane("atan2(y, x)", "domain = [\"x > 0\"]\n"), {"energy"}) == "proved");
    CHECK(statuses(jumping_plane("atan2(y, x)^2"), {"energy", "v_x"}) == "proved where y != 0, refuted");
}

TEST_CASE("a direction of velocities or momenta jumps too, and the condition names the coordinates of the state")
{
    // The velocity turns once in 2 pi.
    const std::string magnetic = "(v_x*y - x*v_y)/2";
    CHECK(statuses(jumping_plane(magnetic), {"atan2(v_y, v_x) + t"}) == "proved where v_y != 0");
    CHECK(statuses(jumping_plane(magnetic), {"atan2(p_v_y - x/2, p_v_x + y/2) + t"}) == "proved where v_y != 0");
}

TEST_CASE("atan2 jumps along Hamilton's equations as along Lagrange's")
{
    const std::string magnetic =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\nmomenta = "
        "[\"p\", \"q\"]\n[algebroid]\nkind = \"tangent\"\n[hamiltonian]\nH = \"((p + y/2)^2 + (q - "
        "x/2)^2)/2\"\n";
    CHECK(statuses(magnetic, {"atan2(v, u) + t", "atan2(v, u) - t", "atan2(v, p) + t"}) ==
          "proved where q - x/2 != 0, refuted, refuted");
}

TEST_CASE("functions of conserved functions are conserved, whatever they are")
{
    CHECK(statuses(jumping_plane("0"), {"atan2(v_y, v_x)", "atan2(p_v_y, p_v_x)", "v_x/sqrt(v_x^2 + v_y^2)",
                                        "abs(v_x)/v_x", "atan(1/(x*v_y - y*v_x))", "atan2(v_y, v_x) + abs(x)/x"}) ==
          "proved, proved, proved, proved, proved, proved where x != 0");
    const std::string kepler =
        "[parameters]\nk = 2\n" + jumping_plane("-k/sqrt(x^2 + y^2)", "domain = [\"k > 0\", \"x^2 + y^2 > 0\"]\n");
    const std::string ex = "v_y*(x*v_y - y*v_x) - k*x/sqrt(x^2 + y^2)",
                      ey = "-v_x*(x*v_y - y*v_x) - k*y/sqrt(x^2 + y^2)";
    CHECK(statuses(kepler, {"atan2(" + ey + ", " + ex + ")", "k/abs(2*energy)", "sqrt((" + ex + ")^2 + (" + ey + ")^2)",
                            "(-2*energy)^(3/2)/k"}) == "proved, proved, proved, proved");
}

TEST_CASE("what depends on parameters alone does not move")
{
    const std::string spring =
        "[parameters]\nk = 2\nm = 3\n[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n"
        "[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"m*v^2/2 - k*x^2/2\"\n";
    CHECK(statuses(spring, {"x*cos(sqrt(k/m)*t) - v/sqrt(k/m)*sin(sqrt(k/m)*t)", "sqrt(v^2 + (k/m)*x^2)",
                            "energy/sqrt(k)", "log(energy/k)", "energy + abs(x)/x"}) ==
          "proved, proved, proved, proved, proved where x != 0");
}

TEST_CASE("what is constant on both sides of a hole says where the hole is")
{
    // x = t of the free particle: each of these has another value at t = -1 than at t = 1.
    const std::pair<const char*, const char*> claims[] = {
        {"abs(x)/x", "x != 0"},
        {"sqrt(x^2)/x", "x != 0"},
        {"x/sqrt(x^2)", "x != 0"},
        {"x^3*abs(x)^(-3)", "x != 0"},
        {"atan(1/x) + atan(x)", "x != 0"},
        {"tanh(x^(-1))*0 + atan(x^(-3)) + atan(x^3)", "x != 0"},
        {"x*exp(-log(x^2)/2)", "x != 0"},
        {"atan(1/log(x^2)) + atan(log(x^2))", "x != 0 and log(x^2) != 0"},
        {"x - atan(tan(x))", "cos(x) != 0"},
        {"(v*abs(x)/x)^2*abs(x)/x", "x != 0"},
        {"atan2(x, x^2) - atan(1/x)", "x != 0"},
    };
    for (const auto& [claim, where] : claims) {
        CAPTURE(claim);
        CHECK(statuses(on_line("0"), {claim}) == std::string("proved where ") + where);
        CHECK(statuses(on_line("0", "domain = [\"x > 0\", \"x < 1\"]\n"), {claim}) == "proved");
    }
    // v does not move, but may be zero; so may the factor of a root in L.
    CHECK(statuses(on_line("0"), {"atan2(0, x)", "atan2(1, x) + atan(x)"}) == "proved where x > 0, proved");
    CHECK(statuses("[parameters]\nc = 1\n" + on_line("x^2/2 - c*sqrt(1 - v^2)"), {"energy"}) ==
          "proved where 1 - v^2 > 0");
    CHECK(statuses(jumping_plane("0", "domain = [\"x*y > 0\"]\n"), {"abs(x*y)/(x*y)"}) == "proved");
}

TEST_CASE("a function that ends is constant on each stretch where it is defined")
{
    // x = cos t, v = -sin t: t + asin(v) is 0 near t = 0, where x > 0, and 2*pi near t = 2*pi.
    const std::string oscillator = on_line("x^2/2");
    CHECK(statuses(oscillator, {"t + asin(v/sqrt(v^2 + x^2)) + 0*sqrt(x)", "t + asin(v/sqrt(v^2 + x^2))"}) ==
          "proved where x > 0, refuted");
    CHECK(statuses(on_line("0"), {"log(x) - log(2*x)", "log(-x) - log(-2*x)", "x^(3/2)/x - sqrt(x)"}) ==
          "proved where x > 0, proved where x < 0, proved where x > 0");
}

TEST_CASE("the holes of a quotient of analytic functions are said, and those of a continuous function are none")
{
    CHECK(statuses(on_line("0"), {"(v*x^2 + v^2*x)/(x^2 + v*x)", "v*sin(x)*x^(-2)*x^2/sin(x)", "v*(abs(x) - sqrt(x^2))",
                                  "(exp(x) - 1)*v/(exp(x) - 1)", "v*log(x)/log(x)"}) ==
          "proved where x^2 + v*x != 0, proved where x != 0 and sin(x) != 0, proved, proved where exp(x) - 1 != 0, "
          "proved where x > 0 and log(x) != 0");
    CHECK(statuses(on_line("abs(x)"), {"energy", "energy*x*(x + v)/(x^2 + x*v)"}) ==
          "proved, proved where x^2 + x*v != 0");
}

TEST_CASE("a run may step over what its equations divide by as they are written, unless the domain keeps it off")
{
    const std::vector<std::string> claims{"v_y*(x*v_y - y*v_x) - x/sqrt(x^2 + y^2)",
                                          "atan(1/(x^2 + y^2)) + atan(x^2 + y^2) + energy"};
    CHECK(statuses(jumping_plane("-1/sqrt(x^2 + y^2)"), claims) ==
          "proved where x^2 + y^2 != 0, proved where x^2 + y^2 != 0");
    CHECK(statuses(jumping_plane("-1/sqrt(x^2 + y^2)", "domain = [\"x^2 + y^2 > 0\"]\n"), claims) == "proved, proved");
    // The force of the first is (0, 1), that of the second finite but at x = 0.
    CHECK(statuses(jumping_plane("(x^2*y + x)/x"), {"abs(x)/x", "energy"}) ==
          "proved where x != 0, proved where x != 0");
    CHECK(statuses(on_line("x*log(x^2)/10"), {"abs(x)/x"}) == "proved where x != 0");
    CHECK(statuses(on_line("sqrt(x^2)/x"), {"energy"}) == "proved where x != 0");
    CHECK(statuses(on_line("(x^2 + x)/x", "domain = [\"x < 0\"]\n"), {"abs(x)/x"}) == "proved");
    const std::string spring = jumping_plane("(x^2 + y^2)/2");
    CHECK(statuses(spring, {"energy + atan(1/(x^2 + y^2)) + atan(x^2 + y^2)"}) == "proved where x^2 + y^2 != 0");
    const std::string side = "[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\nmomenta = [\"p\"]\n"
                             "[algebroid]\nkind = \"tangent\"\n";
    // H, L and forces that the default form has not.
    CHECK(statuses(side + "[lagrangian]\nL = \"v^2/2 - 1/x\"\n[control]\ncontrols = [\"u\"]\nsigma = { v = \"u\" }\n"
                          "cost = \"u^2/2\"\n",
                   {"p + abs(x)/x"}) == "proved where x != 0");
    CHECK(statuses(side + "[lagrangian]\nL = \"v^2/2\"\n[hamiltonian]\nH = \"p^2/2 + 1/x - 1/x\"\n", {"abs(x)/x"}) ==
          "proved where x != 0");
    // Derivatives of R, L and H that divide although the functions do not.
    CHECK(statuses(on_line("x") + "[dissipation]\nR = \"abs(v)^3/3\"\n", {"abs(v)/v"}) == "proved where v != 0");
    CHECK(statuses(side + "[hamiltonian]\nH = \"2/3*abs(p)^(3/2) - x\"\n", {"p - t + abs(p)/p"}) ==
          "proved where p != 0");
    // A power with a parameter as exponent, which may be 2.
    CHECK(statuses("[parameters]\nn = 2\n" + on_line("x^n/2"), {"energy", "energy + abs(x)/x", "x - abs(x)"}) ==
          "proved where x > 0, proved where x > 0, undecided");
}

TEST_CASE("a rate that needs accelerations is one where the mass matrix is regular")
{
    // x u^2 is constant until x = 0, where u is infinite.
    CHECK(statuses(jumping_plane("v_x^2*(1 - x)/2"), {"x*v_x^2", "v_y", "energy"}) ==
          "proved where x != 0, proved, proved");
    CHECK(statuses(jumping_plane("v_x^2*(1 - x)/2", "domain = [\"x > 0\"]\n"), {"x*v_x^2"}) == "proved");
}

TEST_CASE("conditions that cannot be met, or cannot be written, leave a claim undecided")
{
    CHECK(statuses(on_line("0"), {"log(x)*log(-x) - log(-x)*log(x)"}) == "undecided");
    std::string longest = "1/(x";
    for (int k = 1; k <= 20; ++k) longest += " + sin(" + std::to_string(k) + "*x)^" + std::to_string(k);
    longest += ")";
    const std::string long_claim = "v + " + longest + " - " + longest + "*(cos(v)^2 + sin(v)^2)";
    CHECK(statuses(on_line("0"), {long_claim}) == "undecided");
    CHECK(first_obstacle(on_line("0"), {long_claim}) ==
          "its rate vanishes, but it may change where x + sin(x) + sin(2*x)^2 + sin(3*x)^3 + sin(4*x)^4 + sin(5*x)... "
          "vanishes");
}

TEST_CASE("Casimirs and constraints have no holes either")
{
    const std::string casimir = "casimirs = { side = \"x*abs(y)/(abs(y)*x) + abs(x)/x\" }\n";
    CHECK(status_of(verified_text(turning(casimir)), "casimir") == "proved where x != 0 and y != 0");
    CHECK(status_of(verified_text(turning("casimirs = { side = \"log(x^2) - 2*log(abs(x))\" }\n")), "casimir") ==
          "proved where x != 0");
    // The anchor does not know what L divides by.
    CHECK(
        status_of(verified_text(turning("casimirs = { side = \"abs(y)/y\" }\n", "[lagrangian]\nL = \"a^2/2 - 1/y\"\n")),
                  "casimir") == "proved where y != 0");
}

TEST_CASE("an angle jumps where it is on its cut all along a motion and the other side changes its sign")
{
    // v_x = 0 and y from -1 to 1: atan2(0, y) goes from pi to 0, and twice that is in each of these.
    const std::string free = jumping_plane("0");
    for (const char* angle : {"2*v_x", "v_x/1000", "-v_x", "v_x^3", "v_x^2/3", "sqrt(v_x^2)", "v_x*(1 + v_y^2)",
                              "abs(v_x)", "v_x/v_y", "sin(v_x)*0 + v_x*exp(v_y)"}) {
        CAPTURE(angle);
        CHECK(statuses(free, {std::string("atan2(") + angle + ", y) - atan2(2*(" + angle + "), 2*y)"}) ==
              "proved where v_x != 0");
    }
    CHECK(
        statuses(free, {"atan2(v_x*v_y, y) + atan2(-v_x*v_y, y)", "atan2(v_x*x, y) + atan2(-v_x*x, y)",
                        "atan2(2*v_x, v_y) + atan2(-2*v_x, v_y)", "atan2(2*v_x, 1 + y^2) + atan2(-2*v_x, 1 + y^2)"}) ==
        "proved where v_x != 0 and v_y != 0, proved where v_x != 0 and x != 0, proved, proved");
    // Thrown straight up.
    CHECK(statuses(jumping_plane("y"), {"atan2(-v_x, v_y) + atan2(2*v_x, 2*v_y)"}) == "proved where v_x != 0");
    // Divisors: where a constant factor is 0 the function is undefined all along the motion.
    CHECK(statuses(free, {"abs(x*v_x)/(x*v_x)"}) == "proved where x != 0");
    const std::string parameters = "[parameters]\na = 1\nb = 0\n" + free;
    CHECK(statuses(parameters, {"atan2(b*x, y) + atan2(-b*x, y)", "atan2(b^2*v_x, y) + atan2(-b^2*v_x, y)",
                                "atan2(2*(a - 1), y) + atan2(2*(1 - a), y)"}) ==
          "proved where b != 0 and x != 0, proved where b != 0 and v_x != 0, proved where a - 1 != 0");
}

TEST_CASE("Casimirs and constraints whose differential has no terms say where they are constant")
{
    const auto told = [](const std::string& f) {
        const ModelReport report = verified_text(turning("casimirs = { f = \"" + f + "\" }\n"));
        CHECK(report.structure.verdict == Verdict::valid);
        return status_of(report, "casimir");
    };
    CHECK(told("atan2(y, x) + atan2(-y, x)") == "proved where y != 0");
    CHECK(told("abs(y)/y - abs(y)/y") == "proved where y != 0");
    CHECK(told("1/x - 1/x") == "proved where x != 0");
    CHECK(told("x - x + 3").empty());
    const std::string cancels = turning("constraints = [\"x*(phi/phi) - cos(phi)\", \"y - sin(phi)\"]\n");
    CHECK(status_of(verified_text(cancels), "tangency") == "proved where phi != 0, proved");
}

TEST_CASE("conditions are said once, in their shortest form, with the sign that fits")
{
    const std::string free = jumping_plane("0");
    CHECK(statuses(free, {"log(x^(-3)*y) - log(y/x^3)", "log((x^2 - 1)/(1 - x)) - log(-x - 1)",
                          "log(sin(y)^2*x + cos(y)^2*x - 2*x)*0 + 1", "log(x - y) - log(2*x - 2*y)"}) ==
          "proved where x != 0 and y/x^3 > 0, proved where x + 1 < 0, proved where x < 0, proved where x - y > 0");
}

TEST_CASE("terms that stand often in a Lagrangian are looked at once")
{
    const auto begin = std::chrono::steady_clock::now();
    const ModelReport verified =
        verified_text("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n[algebroid]\nkind = \"tangent\"\n"
                      "[lagrangian]\nL = \"v^2/2 + sum(i, 1, 10000, sum(j, 1, 10000, sum(k, 1, 10, x)))\"\n");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    CHECK(verified.structure.verdict == Verdict::valid);
    CHECK(seconds.count() < 5);
}
