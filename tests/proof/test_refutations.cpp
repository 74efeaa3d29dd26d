// SPDX-License-Identifier: GPL-2.0-or-later
/// The zero decision: refutations.
#include "../support/tolerances.hpp"
#include "problem.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;
using namespace lagen::test;

namespace {

struct Row {
    const char* text;
    const char* residual;
    const char* point;
    double value;
};

} // namespace

TEST_CASE("near misses are refuted at a small readable point with the residual in normal form")
{
    const Row rows[] = {
        {"x + y - (x - y)", "2*y", "x=1 y=2 m=3", 4},
        {"(x + y)^2 - x^2 - y^2", "2*x*y", "x=1 y=2 m=3", 4},
        {"sin(x)^2 + cos(x)^2 - 1 - 1/10^15", "-1/1000000000000000", "x=1 y=2 m=3", -1e-15},
        {"sin(x)^2 + cos(x)^2 - 1 + 10^(-30)*x", "x/1000000000000000000000000000000", "x=1 y=2 m=3", 1e-30},
        {"x*y - y*x*(1 + 1/10^12)", "-x*y/1000000000000", "x=1 y=2 m=3", -2e-12},
        {"m*x - x", "m*x - x", "x=1 y=2 m=3", 2},
        {"m*(m - 3)*(x - 1)*(x + 2)", "m^2*x^2 + m^2*x - 2*m^2 - 3*m*x^2 - 3*m*x + 6*m", nullptr, 0},
        {"1/x - 1/y", "(-x + y)/(x*y)", "x=1 y=2 m=3", 0.5},
        {"x/(2*y) - y/3", "(3*x - 2*y^2)/(6*y)", "x=1 y=2 m=3", -5.0 / 12},
    };
    for (const Row& row : rows) {
        Problem problem({{"x", "y"}, {"m"}, {}, {}, {}});
        const Decision decision = problem.decide(row.text);
        INFO(row.text);
        CHECK(to_text(decision.status) == std::string("refuted"));
        CHECK(decision.residual == row.residual);
        REQUIRE(decision.witness);
        if (row.point == nullptr) continue;
        CHECK(point_text(decision) == row.point);
        CHECK(std::abs(decision.witness->value - row.value) <= tolerance::roundoff(2) * std::abs(row.value));
    }
}

TEST_CASE("what holds for one sign of a root only is refuted where the other sign rules")
{
    const char* texts[] = {"sqrt(x^2) - x", "sqrt(x^2 + 2*x*y + y^2) - x - y", "sqrt(1 - sin(x)^2) - cos(x)",
                           "abs(x) - x", "exp(log(x^2)/2) - x"};
    for (const char* text : texts) {
        Problem problem({{"x", "y"}, {}, {}, {}, {}});
        INFO(text);
        CHECK(to_text(problem.decide(text).status) == std::string("refuted"));
    }
}

TEST_CASE("a flipped sign in a trigonometric identity is refuted")
{
    const char* texts[] = {"sin(x + y) - sin(x)*cos(y) + cos(x)*sin(y)",
                           "cos(2*x) - 2*cos(x)^2 - 1",
                           "cosh(x)^2 + sinh(x)^2 - 1",
                           "exp(x + y) - exp(x)*exp(y)*(1 + 1/10^14)",
                           "log(x*y) - log(x) + log(y)",
                           "sqrt(2)*sqrt(3) - sqrt(6) - 1/10^60",
                           "atan(x) + atan(1/x)"};
    for (const char* text : texts) {
        Problem problem({{"x", "y"}, {}, {}, {}, {}});
        INFO(text);
        CHECK(to_text(problem.decide(text).status) == std::string("refuted"));
    }
}

TEST_CASE("a residual below every double is refuted with the least double of its sign")
{
    Problem problem({{"x"}, {}, {}, {}, {}});
    const Decision decision = problem.decide("-exp(-100000*x^2)");
    CHECK(to_text(decision.status) == std::string("refuted"));
    REQUIRE(decision.witness);
    CHECK(decision.witness->value < 0);
    CHECK(decision.residual == "-1/exp(100000*x^2)");
}

TEST_CASE("a constant residual of a model without coordinates is refuted at the empty point")
{
    Problem problem({});
    const Decision decision = problem.decide("1/3");
    CHECK(to_text(decision.status) == std::string("refuted"));
    REQUIRE(decision.witness);
    CHECK(decision.witness->point.empty());
    CHECK(decision.witness->value == 1.0 / 3);
}

TEST_CASE("a long residual is cut after a whole term and says how many there are")
{
    Problem problem({{"x", "y", "z"}, {}, {}, {}, {}});
    const Decision decision = problem.decide("(x + y + z + 1)^6");
    CHECK(decision.residual.size() <= 400);
    CHECK(decision.residual.substr(0, 28) == "x^6 + 6*x^5*y + 6*x^5*z + 6*");
    CHECK(decision.residual.substr(decision.residual.size() - 15) == " ... (84 terms)");
}

TEST_CASE("a status is that of the decision, and points come before polynomials")
{
    const Statement statement{{"x", "y", "z"}, {"a"}, {"x^2 + y^2 - 1"}, {"a > 0"}, {}};
    for (const char* text : {"x^2 + y^2 - 1", "x*y*z", "x/x - 1", "1/(x^2 + y^2 - 1)", "sqrt(-1 - x^2)", "a - abs(a)",
                             "sin(z)^2 + cos(z)^2 - 1", "cos(z) - 1", "(x + y + z + a)^40 - 1"}) {
        INFO(text);
        Problem problem(statement);
        CHECK(to_text(problem.decider->status(problem.node(text))) ==
              std::string(to_text(problem.decide(text).status)));
    }
    // Without points the budget of terms would decide.
    ProofBudget small;
    small.terms = 10;
    small.products = 100;
    Problem problem(statement, small);
    CHECK(to_text(problem.decider->status(problem.node("(x + y + z + a)^40 - 1"))) == std::string("refuted"));
    CHECK(to_text(problem.decider->status(problem.node("(x + y + z)^9 - (x + y + z)^8*(z + y + x)"))) !=
          std::string("refuted"));
}
