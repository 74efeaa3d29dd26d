// SPDX-License-Identifier: GPL-2.0-or-later
/// The zero decision: hostile.
#include "../support/tolerances.hpp"
#include "problem.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;
using namespace lagen::test;

namespace {

std::string status(Problem& problem, const std::string& text)
{
    return to_text(problem.decide(text).status);
}

} // namespace

TEST_CASE("what is defined nowhere is neither proved nor refuted")
{
    const std::string none = "no regular point found in 200 tries";
    Problem root({{"x"}, {}, {}, {}, {}});
    const Decision decision = root.decide("sqrt(-1 - x^2)*(sin(x)^2 + cos(x)^2 - 1)");
    CHECK(to_text(decision.status) == std::string("undecided"));
    CHECK(decision.evidence == none);
    Problem empty({{"x"}, {}, {}, {"x > 1", "x < 0"}, {}});
    CHECK(empty.decide("x - x*(sin(x)^2 + cos(x)^2)").evidence == none);
    CHECK(status(empty, "x") == "undecided");
    CHECK_FALSE(empty.decider->sample_point());
    Problem pointless({{"x"}, {}, {"x^2 + 1"}, {}, {}});
    CHECK(pointless.decide("x^2 + 1").evidence == none);
    CHECK(status(pointless, "x") == "undecided");
    Problem undefined_elsewhere({{"x"}, {}, {}, {}, {"log(-x^2)"}});
    CHECK(undefined_elsewhere.decide("sin(x)^2 + cos(x)^2 - 1").evidence == none);
}

TEST_CASE("a division by something identically zero is undecided and says so")
{
    Problem problem({{"x", "y"}, {}, {}, {}, {}});
    for (const char* text :
         {"1/(sin(x)^2 + cos(x)^2 - 1)", "x/((x + y)^2 - x^2 - 2*x*y - y^2)", "(x*(y + 1) - x*y - x)^(-2)"}) {
        INFO(text);
        const Decision decision = problem.decide(text);
        CHECK(to_text(decision.status) == std::string("undecided"));
        CHECK(decision.evidence == "division by an expression that is identically zero");
    }
    Problem sphere({{"x", "y"}, {}, {"x^2 + y^2 - 1"}, {}, {}});
    CHECK(sphere.decide("x/(x^2 + y^2 - 1)").evidence == "division by an expression that is identically zero");
}

TEST_CASE("cancellation counts only where the divisor is not zero, and x/x is 1 there")
{
    Problem problem({{"x"}, {}, {}, {}, {}});
    CHECK(status(problem, "x/x - 1") == "proved");
    CHECK(status(problem, "(x^2 - 1)/(x - 1) - x - 1") == "proved");
}

TEST_CASE("a power with a variable exponent is evaluated at positive bases alone, and says nothing of the base")
{
    Problem problem({{"x", "y"}, {}, {}, {}, {}});
    CHECK(problem.decide("(-1)^x - abs((-1)^x)").evidence == "no regular point found in 200 tries");
    CHECK(status(problem, "x^y - abs(x)^y") == "undecided"); // for y = 2 and 3 the base may be negative
    CHECK(status(problem, "x^y*x^2 - x^(y + 2)") == "proved");
    CHECK_FALSE(problem.decider->proves_positive(problem.node("x")));
    CHECK(problem.decider->proves_positive(problem.node("x^y")));
    CHECK_FALSE(problem.decider->proves_positive(problem.node("x^(1/3)")));
    CHECK(problem.decider->proves_positive(problem.node("x^(-1/3)")));
}

TEST_CASE("powers, multiples and towers beyond the budget end at once without a wrong verdict")
{
    Problem problem({{"x", "y"}, {}, {}, {}, {}});
    Graph& graph = problem.graph;
    NodeId tower = problem.node("x*y");
    for (int k = 0; k < 4; ++k) tower = graph.power(tower, 64);
    const NodeId zero = graph.multiply(tower, problem.node("sin(x)^2 + cos(x)^2 - 1"));
    const Decision overflow = problem.decider->decide(zero);
    CHECK(to_text(overflow.status) == std::string("undecided"));
    CHECK(overflow.evidence.find("an exponent exceeds 65535") != std::string::npos);
    CHECK(to_text(problem.decider->decide(tower).status) == std::string("refuted"));
    const Decision multiple = problem.decide("sin(1000*x)*cos(x) + cos(1000*x)*sin(x) - sin(1001*x)");
    CHECK(to_text(multiple.status) == std::string("undecided"));
    CHECK(multiple.evidence.find("exceeds the multiple 256") != std::string::npos);
    CHECK(multiple.evidence.substr(0, 7) == "|r| < 1");
}

TEST_CASE("a nest of opaque functions that doubles at each level ends within the budget")
{
    Problem problem({{"x"}, {}, {}, {}, {}});
    Graph& graph = problem.graph;
    NodeId nest = problem.node("x");
    for (int k = 0; k < 60; ++k)
        nest =
            graph.add(graph.apply(Op::atan, nest), graph.divide(graph.constant(1), graph.add(nest, problem.node("2"))));
    const Decision decision = problem.decider->decide(nest);
    CHECK(to_text(decision.status) == std::string("refuted"));
    CHECK(decision.residual.size() <= 400);
}

TEST_CASE("a term budget that is exhausted leaves the evidence of sample points")
{
    ProofBudget budget;
    budget.terms = 100;
    Problem problem({{"x", "y", "z"}, {}, {}, {}, {}}, budget);
    const Decision decision =
        problem.decide("sqrt(3)*(x + y + z + 1)^12 - sqrt(3)*(x + y + z + 1)^12*(sin(x)^2 + cos(x)^2)");
    CHECK(to_text(decision.status) == std::string("undecided"));
    CHECK(decision.evidence.find("term budget of 100 exhausted") != std::string::npos);
    CHECK(to_text(problem.decide("(x + y + z + 1)^12 - 1").status) == std::string("refuted"));
}

TEST_CASE("functions without rules are compared by their arguments alone")
{
    Problem problem({{"x", "y"}, {}, {}, {}, {}});
    CHECK(status(problem, "if(x > y, x, y) - max(x, y)") == "proved");
    CHECK(status(problem, "if(x^4 + x - 2 > x - 1, 1, if(x^4 > 1, 0, 0)) - if(x^4 > 1, 1, 0)") == "proved");
    CHECK(problem.decide("asin(x)*(atan(y) + atan(1/y) - sign(y)*pi/2)").evidence.substr(0, 3) == "|r|");
    CHECK(status(problem, "sign(x)*abs(x) + x") == "refuted");
}

TEST_CASE("a branch that is not taken need not be defined")
{
    Problem problem({{"x"}, {}, {}, {"x < 0"}, {}});
    CHECK(status(problem, "if(x > 0, sqrt(x), 1) - 1") == "proved");
    CHECK(status(problem, "if(x > 0, sqrt(x), 1) + abs(x)") == "refuted");
    CHECK(status(problem, "if(x > 0, sqrt(x), 0) + sqrt(x^2) + x") != "refuted");
}

TEST_CASE("decisions do not depend on what was decided before")
{
    const char* texts[] = {"sin(x) - x", "sin(x/2)*y", "log(x*y) - 1", "1/(x + y) - 1/x", "sqrt(x)*sin(x + y)"};
    Problem together({{"x", "y"}, {}, {}, {}, {}});
    for (int round = 0; round < 2; ++round)
        for (const char* text : texts) {
            Problem alone({{"x", "y"}, {}, {}, {}, {}});
            const Decision a = together.decide(text), b = alone.decide(text);
            INFO(text);
            CHECK(a.residual == b.residual);
            CHECK(point_text(a) == point_text(b));
            CHECK(a.witness->value == b.witness->value);
        }
}

TEST_CASE("the largest bound of an identity is tiny and that of a residual its size")
{
    Problem problem({{"x", "y"}, {}, {}, {"x > 0", "x < 1"}, {}});
    const double zero = problem.decider->largest_bound(problem.node("sin(x + y) - sin(x)*cos(y) - cos(x)*sin(y)"), 5);
    CHECK(zero < 1e-60);
    CHECK(zero > 0);
    const double two = problem.decider->largest_bound(problem.node("2 + x - x"), 5);
    CHECK(std::abs(two - 2) <= 1e-8); // an upper bound with an eight-digit mantissa
    Problem empty({{"x"}, {}, {}, {"x > 1", "x < 0"}, {}});
    CHECK(std::isinf(empty.decider->largest_bound(empty.node("x"), 2)));
}
