// SPDX-License-Identifier: GPL-2.0-or-later
/// Constraints z = f(x) with angles, exponents and divisors, and roots of products beside other roots.
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

std::string status(const Statement& statement, const std::string& residual)
{
    return to_text(Problem(statement).decide(residual).status);
}

} // namespace

TEST_CASE("what the tangent of a constraint divides by is not zero where the constraint is defined")
{
    const Statement graph{{"x", "y", "z"}, {}, {"z - 2*tan(x)"}, {}, {}};
    CHECK(status(graph, "4*(tan(x)^2 + 1) - z^2 - 4") == "proved");
    CHECK(status(graph, "4*(tan(x)^2 + 1) - z^2 - 5") == "refuted");
    const Statement sum{{"x", "y", "z"}, {}, {"z - tan(x + y)"}, {}, {}};
    CHECK(status(sum, "z*cos(x + y) - sin(x + y)") == "proved");
    CHECK(status({{"x", "z"}, {}, {"z - (x + 1)/(x^3 - x)"}, {}, {}}, "z*x*(x - 1) - 1") == "proved");
}

TEST_CASE("a constraint that is multiplied by a function holds where the function vanishes as well")
{
    // At x = 0 the coordinate z is free.
    CHECK(status({{"x", "y", "z"}, {}, {"x*(z - tan(y))"}, {}, {}}, "z - tan(y)") != "proved");
    CHECK(status({{"x", "y", "z"}, {}, {"x*z/(y^2 + 1) - x"}, {}, {}}, "z - y^2 - 1") != "proved");
    CHECK(status({{"x", "y", "z"}, {}, {"x*z/(y^2 + 1) - x"}, {"x > 0"}, {}}, "z - y^2 - 1") == "proved");
}

TEST_CASE("angles and exponents of a residual may be finer than those that a constraint was solved with")
{
    CHECK(status({{"x", "y", "z"}, {}, {"z + cosh(2*y)"}, {}, {}}, "(cosh(2*y) + z)*x*cosh(x + y)") == "proved");
    CHECK(status({{"x", "y", "z"}, {}, {"z + cosh(2*y)"}, {}, {}}, "z + 2*cosh(y)^2 - 1") == "proved");
    CHECK(status({{"x", "y", "z"}, {}, {"z - sin(2*y)"}, {}, {}}, "z - 4*sin(y/2)*cos(y/2)*cos(y)") == "proved");
    CHECK(status({{"x", "y", "z"}, {}, {"z - tan(2*y)"}, {}, {}}, "z*(1 - tan(y)^2) - 2*tan(y)") == "proved");
    CHECK(status({{"x", "y", "z"}, {}, {"z - sin(2*y)"}, {}, {}}, "z - 4*sin(y/2)*cos(y/2)*sin(y)") == "refuted");
}

TEST_CASE("the root of a product is the product of roots of its factors, in any order and beside other roots")
{
    const Statement plane{{"x", "y"}, {}, {}, {}, {}};
    const std::string product = "sqrt((x^2 + 1)*(y^2 + 4)) - sqrt(x^2 + 1)*sqrt(y^2 + 4)";
    CHECK(status(plane, product) == "proved");
    CHECK(status(plane, "x*(" + product + ")/sqrt((x^2 + 1)*(y^2 + 4)) + (" + product + ")*exp(x)*y/sqrt(x^2 + 1)") ==
          "proved");
    CHECK(status(plane, "(" + product + ")*exp(x) + sin(atan(x)) - x/sqrt(x^2 + 1)") == "proved");
    CHECK(status({{"x"}, {}, {}, {"x > 0"}, {}},
                 "(sqrt((x^2 + 1)*(x^2 + 4)) - sqrt(x^2 + 1)*sqrt(x^2 + 4))*(log(x) + sqrt(x))/x") == "proved");
    CHECK(status(plane, "sqrt((x^2 + 1)*(y^2 + 4)) - sqrt(x^2 + 1)*sqrt(y^2 + 5)") == "refuted");
    // x y >= 0 has two parts.
    CHECK(status(plane, "sqrt(x*y)*sqrt(x^2 + 1) - sqrt(x*(x^2 + 1))*sqrt(y)") != "refuted");
    CHECK(status(plane, "sqrt(x*y*(x^2 + 1)) - sqrt(x*y)*sqrt(x^2 + 1)") == "proved");
}

TEST_CASE("small coordinates under a large parameter are among the points that are looked at")
{
    const Statement quadric{{"x", "y", "z", "w"}, {"a"}, {"x^2 + y^2 + z^2 + w^2 - a"}, {}, {}};
    CHECK(status(quadric, "sqrt(cos(x)^2) - cos(x)") == "refuted");
}
