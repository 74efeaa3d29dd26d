// SPDX-License-Identifier: GPL-2.0-or-later
/// Where the momenta are shown to fix the velocities, and what is said where they are not.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// Over u, v with x, y below; parameters m = 1, c = 2 and what `domain` says of them. "only at m = 1" where the value
/// of m in the file is needed; empty where there is no obstacle for any parameters.
std::string obstacle_of(const std::string& lagrangian, const std::string& domain = "\"m > 0\"")
{
    const System system = elaborate(read_model_text(
        "test.toml", "name = \"test\"\n[parameters]\nm = 1\nc = 2\n[base]\ncoordinates = [\"x\", \"y\"]\ndomain = [" +
                         domain +
                         "]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\nkind = \"tangent\"\n"
                         "[lagrangian]\nL = \"" +
                         lagrangian + "\"\n"));
    const Regularity regularity = verify(system).mechanics.regularity;
    std::string values;
    for (const auto& [p, value] : regularity.legendre_values)
        values +=
            (values.empty() ? "only at " : ", ") + system.graph.input_name(p) + " = " + to_text(system.graph, value);
    return regularity.legendre_obstacle.empty() ? values : regularity.legendre_obstacle;
}

const std::string not_definite = "d2L/dy2 is not shown to be definite";

} // namespace

TEST_CASE("a quadratic Lagrangian fixes the velocities whatever the sign of its matrix")
{
    CHECK(obstacle_of("m*(u^2 + v^2)/2 - x^2", "").empty());
    CHECK(obstacle_of("(u^2 - v^2)/2 + x*u").empty());
    CHECK(obstacle_of("u^2*log(x)/2 + abs(y)*v^2 + u*sqrt(x)").empty());
    CHECK(obstacle_of("u^2*exp(v)*exp(-v) + v^2").empty());
}

TEST_CASE("convex and concave Lagrangians on convex sets of velocities fix them")
{
    CHECK(obstacle_of("u^4/4 + u^2/2 + cosh(v)").empty());
    CHECK(obstacle_of("-u^4 - u^2 - exp(v) - v^2").empty());
    CHECK(obstacle_of("u*log(u) + (1 - v)*log(1 - v)").empty());
    CHECK(obstacle_of("sqrt(1 + u^2 + v^2)").empty());
    CHECK(obstacle_of("m*(u^2 + v^2)/2 + 3*m*(u^2 + v^2)^2/(8*c^2)").empty());
    CHECK(obstacle_of("1/sqrt(1 - u^2) + v^2").empty());
}

TEST_CASE("relativistic particles fix their velocities in any frame and metric")
{
    CHECK(obstacle_of("-m*sqrt(1 - u^2 - v^2) - x^2/2").empty());
    CHECK(obstacle_of("m*sqrt(1 - u^2 - v^2)").empty());
    CHECK(obstacle_of("-m*c^2*sqrt(1 - (u^2 + v^2)/c^2) + u*y", "\"m > 0\", \"c > 0\"").empty());
    CHECK(obstacle_of("-m*sqrt(1 - (u + v*x)^2 - v^2)").empty());
    CHECK(obstacle_of("-m*sqrt((1 - 2/x) - u^2/(1 - 2/x) - x^2*v^2)", "\"m > 0\", \"x > 2\"").empty());
}

TEST_CASE("what holds for the parameter values of the file alone says of which parameters")
{
    CHECK(obstacle_of("-m*sqrt(1 - u^2) + v^2/2 + c*x", "") == "only at m = 1");
    CHECK(obstacle_of("-m*sqrt(1 - u^2) + v^2/2 + c*x").empty());
    CHECK(obstacle_of("m*(u^4/4 + u^2) + c*cosh(v)", "") == "only at m = 1, c = 2");
    CHECK(obstacle_of("m*(u^4/4 + u^2) + c*cosh(v)") == "only at c = 2");
    CHECK(obstacle_of("u^2/2 + v^2/2 + (c - m)*(u^4 + v^4)", "\"c > 1\"") == "only at m = 1");
    // Nothing is known for m = 1 either.
    CHECK(obstacle_of("u^4/4 - m*u^2/2 + v^2/2", "") == not_definite);
    CHECK(obstacle_of("u^2/(m - u^2) + v^2/2", "") ==
          "m - u^2 is not shown to be nonzero, and L is smooth only where it is");
}

TEST_CASE("several velocities with one momentum are not let through")
{
    // p = u^3 - u has three roots near p = 0.
    CHECK(obstacle_of("u^4/4 - u^2/2 + v^2/2") == not_definite);
    // det W = (1 + 2 v^2)(1 + 2 u^2) - 16 u^2 v^2
    CHECK(obstacle_of("u^2/2 + v^2/2 + u^2*v^2") == not_definite);
    // W = diag(3 u^2, 1) vanishes at u = 0, where Newton's method starts.
    CHECK(obstacle_of("u^4/4 + v^2/2") == not_definite);
    CHECK(obstacle_of("u^3/6 + v^2/2") == not_definite);
}

TEST_CASE("a definite matrix on a set that is not convex is not enough")
{
    // p = 2 u - 2/u^3 takes every value for u < 0 and again for u > 0.
    CHECK(obstacle_of("u^2 + 1/u^2 + v^2") == "u^2 is not shown to be nonzero, and L is smooth only where it is");
    CHECK(obstacle_of("1/(1 - u^2) + v^2") == "1 - u^2 is not shown to be nonzero, and L is smooth only where it is");
    // p = u - 5 sign(u)
    CHECK(obstacle_of("u^2/2 - 5*abs(u) + v^2") == "u is not shown to be nonzero, and L is smooth only where it is");
    CHECK(obstacle_of("u^2/2 - 5*sqrt(u^2) + v^2") == "u is not shown to be nonzero, and L is smooth only where it is");
    CHECK(obstacle_of("u^2 + v^2 + sqrt(u^2 + v^2)") ==
          "u^2 + v^2 is not shown to be positive, and L is smooth only where it is");
    CHECK(obstacle_of("u^2 + v^2 + atan2(u, v)") == "v is not shown to be positive, and L is smooth only where it is");
    CHECK(obstacle_of("u^2 + v^2 + atan2(u, x)/9") ==
          "x is not shown to be positive, and L is smooth only where it is");
    CHECK(obstacle_of("tan(u) + v^2") == "cos(u) is not shown to be nonzero, and L is smooth only where it is");
}

TEST_CASE("a concave argument of a logarithm is a condition, also where the momenta go on beyond it")
{
    for (const char* lagrangian : {"-log(u) + v^2", "-log(1 - u) + v^2", "-log(1 - u^2 - v^2) + u^2/2"})
        CHECK(obstacle_of(lagrangian).empty());
    CHECK(obstacle_of("-log(u^2) + v^2") == "u^2 is not shown to be positive, and L is smooth only where it is");
}

TEST_CASE("a root keeps a divisor away from zero")
{
    CHECK(obstacle_of("1/(1 - v) + u^2/2") == "1 - v is not shown to be nonzero, and L is smooth only where it is");
    CHECK(obstacle_of("1/(1 - v) - sqrt(1 - v) + u^2/2").empty());
}

TEST_CASE("a force that is defined for fewer velocities does not make them unique")
{
    const std::string cubic = "[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"u\"]\n[algebroid]\nkind = "
                              "\"tangent\"\n[lagrangian]\nL = \"u^3/6\"\n[forces]\nu = \"log(u)\"\n";
    CHECK(verified_text(cubic).mechanics.regularity.legendre_obstacle == not_definite);
}

TEST_CASE("Newton's method starts where the momenta are defined")
{
    const auto start = [](const std::string& lagrangian) {
        return verified_text("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"u\"]\n[algebroid]\nkind = "
                             "\"tangent\"\n[lagrangian]\nL = \"" +
                             lagrangian + "\"\n")
            .mechanics.regularity.newton_start;
    };
    CHECK(start("exp(u)").empty());
    CHECK(start("-sqrt(1 - u^2)").empty());
    REQUIRE(start("u*log(u)").size() == 1);
    CHECK(start("u*log(u)")[0] > 0);
    REQUIRE(start("(-u - 1)*log(-u - 1)").size() == 1);
    CHECK(start("(-u - 1)*log(-u - 1)")[0] < -1);
}

TEST_CASE("a Hamiltonian alone is asked whether the velocities fix the momenta")
{
    const auto of = [](const std::string& hamiltonian) {
        return verified_text("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\nmomenta = [\"p\"]\n"
                             "[algebroid]\nkind = \"tangent\"\n[hamiltonian]\nH = \"" +
                             hamiltonian + "\"\n")
            .mechanics.regularity.legendre_obstacle;
    };
    CHECK(of("p^2/2 + x^2").empty());
    CHECK(of("sqrt(1 + p^2) + x^2").empty());
    CHECK(of("p^4/4 - p^2/2") == "d2H/dmu2 is not shown to be definite");
    CHECK(of("abs(p)") == "p is not shown to be nonzero, and H is smooth only where it is");
}
