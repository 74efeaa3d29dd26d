// SPDX-License-Identifier: GPL-2.0-or-later
/// The zero decision: constraints.
#include "../support/tolerances.hpp"
#include "problem.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;
using namespace lagen::test;

namespace {

const Statement sphere{{"g1", "g2", "g3"}, {}, {"g1^2 + g2^2 + g3^2 - 1"}, {}, {}};

} // namespace

TEST_CASE("what holds on the sphere alone is proved there and refuted without the constraint")
{
    const char* texts[] = {"g1^2 + g2^2 + g3^2 - 1", "(1 - g3^2)/(g1^2 + g2^2) - 1",
                           "sqrt(g1^2 + g2^2) - sqrt(1 - g3^2)", "g3^4 - (1 - g1^2 - g2^2)^2"};
    for (const char* text : texts) {
        INFO(text);
        Problem on(sphere);
        CHECK(to_text(on.decide(text).status) == std::string("proved"));
        Problem off({{"g1", "g2", "g3"}, {}, {}, {}, {}});
        CHECK(to_text(off.decide(text).status) == std::string("refuted"));
    }
}

TEST_CASE("witnesses on the sphere are rational points of it")
{
    Problem problem(sphere);
    const Decision decision = problem.decide("g1^2 + g2^2 + g3^2 - 2");
    CHECK(to_text(decision.status) == std::string("refuted"));
    CHECK(decision.residual == "-1");
    REQUIRE(decision.witness);
    CHECK(decision.witness->value == -1);
    Rational norm;
    for (const auto& [name, value] : decision.witness->point) norm += value.exact.value() * value.exact.value();
    CHECK(norm == 1);
}

TEST_CASE("a root of one sign only is refuted on the other half of the sphere")
{
    Problem problem(sphere);
    const Decision decision = problem.decide("g3 - sqrt(1 - g1^2 - g2^2)");
    CHECK(to_text(decision.status) == std::string("refuted"));
    CHECK(decision.witness->value < 0);
    Problem half({{"g1", "g2", "g3"}, {}, {"g1^2 + g2^2 + g3^2 - 1"}, {"g3 > 0"}, {}});
    CHECK(to_text(half.decide("g3 - sqrt(1 - g1^2 - g2^2)").status) == std::string("proved"));
}

TEST_CASE("irrational points of a constraint are printed with twenty digits")
{
    Problem problem({{"x"}, {}, {"x^2 - 2"}, {"x > 0"}, {}});
    const Decision decision = problem.decide("x - 1");
    CHECK(to_text(decision.status) == std::string("refuted"));
    CHECK(point_text(decision) == "x=1.4142135623730950488");
    CHECK(decision.residual == "x - 1");
    CHECK(to_text(problem.decide("x^3 - 2*x").status) == std::string("proved"));
}

TEST_CASE("cubes and quadratics with a linear term are solved")
{
    Problem cubic({{"x", "y"}, {}, {"y^3 + x^3 - 1"}, {}, {}});
    CHECK(to_text(cubic.decide("y^6 - (1 - x^3)^2").status) == std::string("proved"));
    CHECK(to_text(cubic.decide("y^2 + x").status) == std::string("refuted"));
    Problem quadratic({{"y"}, {}, {"y^2 - 5*y + 6"}, {}, {}});
    CHECK(to_text(quadratic.decide("(y - 2)*(y - 3)").status) == std::string("proved"));
    const Decision one = quadratic.decide("y - 2");
    CHECK(point_text(one) == "y=3");
    CHECK(one.witness->value == 1);
}

TEST_CASE("several constraints are solved in the order of their coordinates")
{
    Problem problem({{"x", "y", "z", "w"}, {"a"}, {"w - x*z", "x^2 + y^2 - a^2", "z - sin(x)"}, {"a > 0"}, {}});
    CHECK(to_text(problem.decide("w - x*sin(x)").status) == std::string("proved"));
    CHECK(to_text(problem.decide("w^2*y^2 - x^2*z^2*(a^2 - x^2)").status) == std::string("proved"));
    CHECK(to_text(problem.decide("w - x").status) == std::string("refuted"));
}

TEST_CASE("constraints with constant or certainly nonzero leading coefficients are made monic")
{
    Problem ellipse({{"x", "y"}, {"a", "b"}, {"x^2/a^2 + y^2/b^2 - 1"}, {"a > 0", "b > 0"}, {}});
    CHECK(to_text(ellipse.decide("b^2*x^2 + a^2*y^2 - a^2*b^2").status) == std::string("proved"));
    Problem numbers({{"x", "y"}, {}, {"x^2/4 + y^2/9 - 1"}, {}, {}});
    const Decision decision = numbers.decide("y");
    CHECK(to_text(decision.status) == std::string("refuted"));
    CHECK(decision.residual == "y");
}

TEST_CASE("a coefficient that may vanish keeps a proof back and is named")
{
    Problem problem({{"x", "w"}, {}, {"x*w"}, {}, {}});
    const Decision decision = problem.decide("w");
    CHECK(to_text(decision.status) == std::string("undecided"));
    CHECK(decision.evidence == "r = 0 at 3 points; zero wherever x != 0, which is not shown on the whole domain");
    Problem away({{"x", "w"}, {}, {"x*w"}, {"x > 0"}, {}});
    CHECK(to_text(away.decide("w").status) == std::string("proved"));
}

TEST_CASE("multiples of a constraint are proved zero where its coefficient may vanish")
{
    const Statement tangent_sphere{
        {"g1", "g2", "g3", "v1", "v2", "v3"}, {}, {"g1^2 + g2^2 + g3^2 - 1", "g1*v1 + g2*v2 + g3*v3"}, {}, {}};
    Problem problem(tangent_sphere);
    CHECK(to_text(problem.decide("g1*v1 + g2*v2 + g3*v3").status) == std::string("proved"));
    CHECK(to_text(problem.decide("(g1*v1 + g2*v2)*(v1 + g2) + g3*v3*(v1 + g2)").status) == std::string("proved"));
    CHECK(to_text(problem.decide("g1*v1 + g2*v2 - g3*v3").status) == std::string("refuted"));
}

TEST_CASE("constraints that are not triangular are refused with their number")
{
    const Statement statement{{"x", "y"}, {}, {"x - y", "x^2 + x*y^2 + y^3 + x^3*y - 1", "x + y"}, {}, {}};
    const std::string expected =
        "base constraint 2, x^2 + x*y^2 + y^3 + x^3*y - 1, is not triangular: it must solve for a "
        "base coordinate that no other constraint solves for, linearly or as a power with a "
        "constant coefficient";
    try {
        Problem problem(statement);
        FAIL("accepted");
    } catch (const TriangularityError& error) {
        CHECK(error.message() == expected);
        CHECK(error.index() == 1);
        CHECK(error.code() == ExitCode::refuted);
    }
}

TEST_CASE("a witness carries its values: exact where they are rational, else a decimal inside its enclosure")
{
    Problem problem({{"x", "y"}, {}, {"y^2 - 2"}, {"y > 0", "x > 0"}, {}});
    const Decision decision = problem.decide("x*y");
    REQUIRE(decision.witness);
    const PointValue& x = decision.witness->point[0].second;
    const PointValue& y = decision.witness->point[1].second;
    REQUIRE(x.exact);
    CHECK(x.decimal.empty());
    CHECK(to_text(x) == x.exact->get_str());
    const Rational square = 2;
    REQUIRE_FALSE(y.exact);
    CHECK(y.lower * y.lower < square);
    CHECK(square < y.upper * y.upper);
    CHECK(y.upper - y.lower < Rational(1, 1'000'000'000'000'000'000));
    CHECK(std::abs(to_double(y) - std::sqrt(square.get_d())) <= tolerance::roundoff(4) * to_double(y));
    CHECK(std::abs(std::stod(to_text(y)) - to_double(y)) <= tolerance::roundoff(2) * to_double(y));
}
