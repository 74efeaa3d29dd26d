// SPDX-License-Identifier: GPL-2.0-or-later
/// Which controls are proved to maximise H, which are certainly no maximum, and what is said of the others.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using Kind = ControlMaximum::Kind;

namespace {

ControlMaximum maximum_of(const std::string& control)
{
    return verified_text("[parameters]\nk = 1\nc = 2\n[base]\ncoordinates = [\"x\", \"y\"]\ndomain = [\"c > 0\"]\n"
                         "[fibre]\ncoordinates = [\"a\", \"b\"]\nmomenta = [\"p\", \"q\"]\n[algebroid]\nkind = "
                         "\"tangent\"\n[control]\n" +
                         control)
        .control.maximum;
}

ControlMaximum of_one(const std::string& cost, const std::string& bounds = "")
{
    return maximum_of("controls = [\"u\"]\nsigma = { a = \"u\" }\ncost = \"" + cost + "\"\n" +
                      (bounds.empty() ? "" : "bounds = { u = " + bounds + " }\n"));
}

ControlMaximum of_two(const std::string& cost, const std::string& bounds = "")
{
    return maximum_of("controls = [\"u\", \"w\"]\nsigma = { a = \"u\", b = \"w\" }\ncost = \"" + cost + "\"\n" +
                      (bounds.empty() ? "" : "bounds = " + bounds + "\n"));
}

} // namespace

TEST_CASE("a strictly concave and smooth Hamiltonian is proved to have its maximum", "[maximum]")
{
    for (const char* cost : {"u^2/2", "c*u^2/2 + k*u", "cosh(u)", "sqrt(1 + u^2)", "exp(u) - u", "u^4/4",
                             "(2 + sin(x))*u^2", "u^2*abs(1 + x^2)", "atan2(x, 1)*u + u^2"}) {
        INFO(cost);
        CHECK(of_one(cost).kind == Kind::maximal);
    }
    CHECK(of_two("u^2 + u*w + w^2").kind == Kind::maximal);
    CHECK(of_two("(1 + x^2)*u^2 + (u - w)^2").kind == Kind::maximal);
}

TEST_CASE("between bounds the interval counts, its ends included", "[maximum]")
{
    const std::vector<std::pair<const char*, const char*>> proved = {{"-log(cos(u))", "[-1.5, 1.5]"},
                                                                     {"u^2/2 + 1/u^2", "[0.5, 20]"},
                                                                     {"-log(1 - u^2)", "[-0.99, 0.99]"},
                                                                     {"u^3", "[0.1, 2]"},
                                                                     {"-sin(u)", "[0.1, \"pi/2\"]"},
                                                                     {"u^2 + abs(u + 2)", "[-1, 1]"},
                                                                     {"u^2", "[\"-c\", \"c\"]"},
                                                                     {"u^3", "[\"c\", \"inf\"]"},
                                                                     {"-sqrt(u)", "[1, inf]"}};
    for (const auto& [cost, bounds] : proved) {
        INFO(cost << " on " << bounds);
        CHECK(of_one(cost, bounds).kind == Kind::maximal);
    }
    const std::string needed = "with bounds on controls H must be separable, smooth and strictly concave in them, or "
                               "dH/du = 0 and the bounds do not give its maximum: ";
    const std::vector<std::array<const char*, 3>> refused = {
        {"u^3", "[0, 2]", "d2H/du2 < 0 was not proved for all admissible u"},
        {"u^2/2 + 1/u^2", "[-1, 1]", "1/u^2 was not proved to be smooth for all admissible controls"},
        {"-log(1 - u^2)", "[-1, 1]", "log(1 - u^2) was not proved to be smooth for all admissible controls"},
        {"u^2 - log(1 + u)/8", "[-2, 1]", "log(1 + u) was not proved to be smooth for all admissible controls"},
        {"k*u^2", "[-1, 1]", "d2H/du2 < 0 was not proved for all admissible u"},
        {"-u^2", "[-1, 1]", "d2H/du2 < 0 was not proved for all admissible u"}};
    for (const auto& [cost, bounds, why] : refused) {
        INFO(cost << " on " << bounds);
        const ControlMaximum maximum = of_one(cost, bounds);
        CHECK(maximum.kind == Kind::unsolved);
        CHECK(maximum.reason == needed + why);
    }
    CHECK(of_two("u^2 + u*w + w^2", "{ u = [-1, 1] }").reason == needed + "d2H/dudw is not zero");
    CHECK(of_two("u^2 + w^2", "{ u = [-1, 1] }").kind == Kind::maximal);
}

TEST_CASE("a Hamiltonian that certainly has no maximum is refuted", "[maximum]")
{
    CHECK(of_one("-u^2/2 + x^2").reason == "H has no maximum in the control 'u': d2H/du2 > 0");
    CHECK(of_one("-u^2/2 + x^2").kind == Kind::refuted);
    CHECK(of_two("u^2 - w^2").reason == "H has no maximum in the control 'w': d2H/dw2 > 0");
    CHECK(of_two("u*w").reason == "H has no maximum in the controls 'u' and 'w': d2H/du2 is indefinite");
    CHECK(of_two("u*w").kind == Kind::refuted);
    CHECK(of_two("u^2 + 3*u*w + w^2").kind == Kind::refuted);
    // H = mu u - sqrt(1 - u^2) has its maximum at an end of the interval where it is defined.
    for (const char* cost : {"sqrt(1 - u^2)", "log(1 - u^2)"}) {
        CHECK(of_one(cost).kind == Kind::refuted);
        CHECK(of_one(cost).reason == "dH/du = 0 is where H is least: d2H/du2 > 0 wherever H is defined");
    }
}

TEST_CASE("where nothing is proved of a maximum the controls are stationary", "[maximum]")
{
    for (const char* cost : {"-cos(u)", "k*u^2", "u^4/4 - u^2/2", "u^3", "x*u^2"}) {
        INFO(cost);
        const ControlMaximum maximum = of_one(cost);
        CHECK(maximum.kind == Kind::stationary);
        CHECK(maximum.reason == "d2H/du2 < 0 was not proved for all u");
    }
    CHECK(of_one("u^2/2 + 1/u^2").reason == "1/u^2 was not proved to be smooth for all controls");
}

TEST_CASE("a cost that is defined and strictly convex on a convex set of controls has its maximum there", "[maximum]")
{
    for (const char* cost : {"-log(1 - u^2)", "-sqrt(1 - u^2)", "u^2/2 - log(1 + u) - log(2 - u)", "(1 - u)^(-3/2)"}) {
        INFO(cost);
        const ControlMaximum maximum = of_one(cost);
        CHECK(maximum.kind == Kind::maximal);
        CHECK(maximum.on_part);
        CHECK(maximum.newton_start.empty());
    }
    const ControlMaximum entropy = of_one("u*log(u)");
    CHECK(entropy.kind == Kind::maximal);
    REQUIRE(entropy.newton_start.size() == 1);
    CHECK(entropy.newton_start[0] > 0);
    CHECK_FALSE(of_one("exp(u)").on_part);
    // Two intervals, and a cost that is neither convex nor concave.
    for (const char* cost : {"-log(u^2 - 1)", "-log(u^2)", "1/sqrt(u^2 - 1)", "sqrt(1 - u) + u^2"})
        CHECK(of_one(cost).kind == Kind::stationary);
    CHECK(of_two("-log(1 - u - w)").kind != Kind::maximal);
    CHECK(of_two("-log(1 - u^2 - w^2)").on_part);
}

TEST_CASE("kinks, affine and dependent controls are named", "[maximum]")
{
    CHECK(of_one("abs(u) + u^2/2").kind == Kind::nonsmooth);
    CHECK(of_one("abs(u) + u^2/2").reason ==
          "H is not smooth in the controls: it contains abs(u), where u was not proved to keep its sign");
    CHECK(of_one("u^2/2 - abs(u)", "[-4, 1]").kind == Kind::nonsmooth);
    CHECK(of_one("u^2 + atan2(x, u)").reason ==
          "H is not smooth in the controls: it contains atan2(x, u), which was not proved to keep off its cut");
    CHECK(of_one("x^2").reason == "H is affine in the control u: dH/du = 0 does not determine it; without two bounds H "
                                  "has a maximum only where dH/du = p is 0 (a singular control)");
    CHECK(of_one("x^2", "[-1, 1]").reason ==
          "H is affine in the control u: dH/du = 0 does not determine it; between its bounds it is bang-bang, at the "
          "upper "
          "one where dH/du = p > 0 and at the lower one where it is < 0, and what is missing are motions that switch "
          "there");
    const ControlMaximum dependent = of_two("(u + w)^2");
    CHECK(dependent.kind == Kind::unsolved);
    CHECK(dependent.reason ==
          "dH/du = 0 does not determine the controls: d2H/du2 has rank 1, and 2 controls need rank 2");
    CHECK(of_two("(u + w)^4").kind == Kind::unsolved);
}

TEST_CASE("an angle in which H is a + b cos u + c sin u has its maximum in closed form, proved", "[maximum]")
{
    const auto on_circle = [](const std::string& sigma, const std::string& cost = "1") {
        return maximum_of("controls = [\"u\"]\nsigma = { " + sigma + " }\ncost = \"" + cost + "\"\n");
    };
    const std::vector<std::pair<const char*, const char*>> proved = {
        {"a = \"c*cos(u) - c*y/k\", b = \"c*sin(u)\"", "1"},
        {"a = \"cos(u + 7*pi/12)\", b = \"sin(u + 7*pi/12)\"", "1"},
        {"a = \"cos(k - u)\", b = \"x*y\"", "x^2 + t"},
        {"a = \"x*sin(u + x)\"", "sin(u)*y"},
        {"a = \"2*cos(u/2)^2\", b = \"2*sin(u/2)*cos(u/2)\"", "1"},
        {"a = \"sqrt(x)*cos(u)\", b = \"log(y)\"", "1"}};
    for (const auto& [sigma, cost] : proved) {
        INFO(sigma << " at " << cost);
        const ControlMaximum maximum = on_circle(sigma, cost);
        CHECK(maximum.kind == Kind::maximal);
        CHECK(maximum.angles == std::vector<std::size_t>{0});
        CHECK(maximum.reason == "H = a + b cos(u) + c sin(u) is largest at u = atan2(c, b), wherever b or c is not 0");
    }
    const std::vector<std::pair<const char*, const char*>> others = {
        {"a = \"cos(2*u)\"", "1"},      {"a = \"cos(u)\", b = \"sin(u)\"", "u^2/8"},
        {"a = \"cos(u)\"", "cos(u)^2"}, {"a = \"u*cos(u)\"", "1"},
        {"a = \"cos(k*u)\"", "1"},      {"a = \"cos(u)\"", "1/(2 + u)^2"}};
    for (const auto& [sigma, cost] : others) {
        INFO(sigma << " at " << cost);
        CHECK(on_circle(sigma, cost).angles.empty());
        CHECK(on_circle(sigma, cost).kind == Kind::stationary);
    }
}

TEST_CASE("angles stand beside other controls of every kind, where they stand apart", "[maximum]")
{
    const auto of_sum = [](const std::string& a, const std::string& b, const std::string& cost,
                           const std::string& bounds = "") {
        return maximum_of("controls = [\"u\", \"w\"]\nsigma = { a = \"" + a + "\", b = \"" + b + "\" }\ncost = \"" +
                          cost + "\"\n" + (bounds.empty() ? "" : "bounds = " + bounds + "\n"));
    };
    CHECK(of_sum("cos(u) + w", "sin(u)", "w^2").kind == Kind::maximal);
    CHECK(of_sum("cos(u) + w", "sin(u)", "w^2").angles == std::vector<std::size_t>{0});
    CHECK(of_sum("cos(u)", "x*cos(w)", "1").angles == std::vector<std::size_t>{0, 1});
    CHECK(of_sum("u", "sin(w)", "cosh(u)", "{ u = [-1, 1] }").kind == Kind::maximal);
    CHECK(of_sum("u", "sin(w)", "cosh(u)", "{ u = [-1, 1] }").angles == std::vector<std::size_t>{1});
    CHECK(of_sum("cos(u)", "w", "-log(1 - w^2)").on_part);
    const std::string heading = "H = a + b cos(u) + c sin(u) is largest at u = atan2(c, b)";
    CHECK(of_sum("cos(u) + w", "sin(u)", "w^2").reason ==
          heading + ", wherever b or c is not 0; H is concave in w, and largest where dH/dw = 0");
    CHECK(of_sum("cos(u)", "w", "-log(1 - w^2)").reason ==
          heading + ", wherever b or c is not 0; H is concave in w where it is defined, and largest where dH/dw = 0");
    CHECK(of_sum("cos(u)", "x*cos(w)", "1").reason ==
          heading + "; H = a + b cos(w) + c sin(w) is largest at w = atan2(c, b), wherever b or c is not 0");
    const ControlMaximum half = of_sum("cos(u)", "w", "w^4 - w^2");
    CHECK(half.kind == Kind::stationary);
    CHECK(half.angles == std::vector<std::size_t>{0});
    CHECK(half.reason == "d2H/du2 < 0 was not proved for all w");
    CHECK(of_sum("cos(u)", "sin(u)", "-w^2").kind == Kind::refuted);
    // Affine in one of them, and a bound on the angle.
    CHECK(of_sum("cos(u)", "sin(u) + w", "1").kind == Kind::unsolved);
    CHECK(of_sum("cos(u)", "w", "w^2", "{ u = [-1, 1] }").angles.empty());
    // b is 1 for w > 0 and -1 for w < 0, though d2H/dudw = 0.
    CHECK(of_sum("cos(u)*sqrt(w^2)/w", "sin(u)", "w^2").angles.empty());
    // In w alone, with u = 0, H has the form of an angle; as it is written its b contains u.
    const ControlMaximum folded = of_sum("cos(w)*(cos(u)^2 + sin(u)^2)", "sin(u)", "1");
    CHECK(folded.angles == std::vector<std::size_t>{0});
    CHECK(folded.kind == Kind::stationary);
    // The size of a vector and its angle do not stand apart.
    CHECK(of_sum("w*cos(u)", "w*sin(u)", "w^2").angles.empty());
}

TEST_CASE("what is known beside an angle names the other controls together, between bounds one by one", "[maximum]")
{
    const auto of_three = [](const std::string& cost, const std::string& bounds) {
        return maximum_of("controls = [\"u\", \"w\", \"z\"]\nsigma = { a = \"cos(u) + w\", b = \"sin(u) + z\" }\n"
                          "cost = \"" +
                          cost + "\"\n" + bounds)
            .reason;
    };
    const std::string heading = "H = a + b cos(u) + c sin(u) is largest at u = atan2(c, b), wherever b or c is not 0; ";
    CHECK(of_three("w^2 + w*z + z^2", "") == heading + "H is concave in (w, z), and largest where dH/d(w, z) = 0");
    CHECK(of_three("w^2 + z^2", "bounds = { w = [-1, 1] }\n") ==
          heading + "H is concave in w within its bounds, and largest where dH/dw = 0 or at the bound next to that; "
                    "H is concave in z, and largest where dH/dz = 0");
}
