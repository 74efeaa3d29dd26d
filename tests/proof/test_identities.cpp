// SPDX-License-Identifier: GPL-2.0-or-later
/// The zero decision: identities.
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

TEST_CASE("identities that hold wherever both sides are defined are proved")
{
    const char* identities[] = {
        "(x + y)^2 - x^2 - 2*x*y - y^2",
        "(x^3 - y^3)/(x - y) - x^2 - x*y - y^2",
        "1/(x - y) - 1/(x + y) - 2*y/(x^2 - y^2)",
        "x/(x*y + x^2) - 1/(x + y)",
        "sin(x)^2 + cos(x)^2 - 1",
        "sin(x + y) - sin(x)*cos(y) - cos(x)*sin(y)",
        "cos(x - y + z) - cos(x)*cos(y - z) - sin(x)*sin(y - z)",
        "cos(2*x) - 2*cos(x)^2 + 1",
        "sin(3*x) - 3*sin(x) + 4*sin(x)^3",
        "sin(x/2)^2 - (1 - cos(x))/2",
        "sin(2*x/3)*cos(x/3) + cos(2*x/3)*sin(x/3) - sin(x)",
        "tan(x)^2 + 1 - 1/cos(x)^2",
        "tan(x + y) - (tan(x) + tan(y))/(1 - tan(x)*tan(y))",
        "sin(1/x + 1/y) - sin((x + y)/(x*y))",
        "sin(100*x) - 2*sin(50*x)*cos(50*x)",
        "sin(x + pi/2) - cos(x)",
        "cos(pi/6) - sqrt(3)/2",
        "sin(pi/12) - (sqrt(6) - sqrt(2))/4",
        "cosh(x)^2 - sinh(x)^2 - 1",
        "sinh(x + y) - sinh(x)*cosh(y) - cosh(x)*sinh(y)",
        "tanh(x) - sinh(x)/cosh(x)",
        "exp(x + y) - exp(x)*exp(y)",
        "exp(x/2)^2 - exp(x)",
        "exp(-x)*exp(x) - 1",
        "exp(2*log(x)) - x^2",
        "exp(log(x)/2) - sqrt(x)",
        "log(exp(x*y)) - x*y",
        "log(6) - log(2) - log(3)",
        "log(x*y) - log(x) - log(y)",
        "log(x^2) - 2*log(abs(x))",
        "log(sin(x)^2 + cos(x)^2)",
        "log(sqrt(x)) - log(x)/2",
        "sqrt(2)*sqrt(3) - sqrt(6)",
        "sqrt(12) - 2*sqrt(3)",
        "sqrt(5 + 2*sqrt(6)) - sqrt(2) - sqrt(3)",
        "sqrt(8*x) - 2*sqrt(2)*sqrt(x)",
        "sqrt(x*y) - sqrt(x)*sqrt(y)",
        "sqrt(x^2) - abs(x)",
        "sqrt(x^2 + 2*x*y + y^2) - abs(x + y)",
        "sqrt(1 - sin(x)^2) - abs(cos(x))",
        "x/sqrt(x^2 + y^2)*sqrt(x^2 + y^2) - x",
        "x^(1/3)*x^(2/3) - x",
        "(x^y)^2 - x^(2*y)",
        "abs(x*y) - abs(x)*abs(y)",
        "abs(x)/x - x/abs(x)",
        "atan((x^2 - 1)/(x - 1)) - atan(x + 1)",
        "max(x + x*y, 0) - max(x*(1 + y), 0)",
    };
    for (const char* text : identities) {
        Problem problem({{"x", "y", "z"}, {}, {}, {}, {}});
        const Decision decision = problem.decide(text);
        INFO(text << ": " << decision.residual << "; " << decision.evidence);
        CHECK(to_text(decision.status) == std::string("proved"));
        CHECK(decision.residual == "0");
        CHECK(decision.evidence.empty());
        CHECK_FALSE(decision.witness);
    }
}

TEST_CASE("the domain decides the signs of roots and logarithms")
{
    const char* identities[] = {
        "sqrt(x^2) - x",
        "sqrt(y^2) + y",
        "abs(x) - x",
        "sqrt(x^2*y^2) + x*y",
        "log(x^2) - 2*log(x)",
        "log(x*y^2) - log(x) - 2*log(-y)",
        "sqrt((x - y)^2) - x + y",
        "sqrt(x/z^4) - sqrt(x)/z^2",
    };
    for (const char* text : identities) {
        Problem problem({{"x", "y", "z"}, {}, {}, {"x > 5", "y < -3", "z != 0"}, {}});
        INFO(text);
        CHECK(to_text(problem.decide(text).status) == std::string("proved"));
    }
}

TEST_CASE("components of small linear solves are eliminated by Cramer's rule")
{
    Problem problem({{"x", "y"}, {}, {}, {}, {}});
    Graph& graph = problem.graph;
    const NodeId x = problem.node("x"), y = problem.node("y"), one = graph.constant(1);
    const NodeId matrix[] = {x, one, one, y};
    const NodeId right[] = {one, x};
    const std::vector<NodeId> z = graph.solve(matrix, right, MatrixStructure::general);
    // x z0 + z1 = 1
    const NodeId first = graph.subtract(graph.add(graph.multiply(x, z[0]), z[1]), one);
    CHECK(to_text(problem.decider->decide(first).status) == std::string("proved"));
    const Decision wrong = problem.decider->decide(graph.subtract(z[0], y));
    CHECK(to_text(wrong.status) == std::string("refuted"));
    CHECK(wrong.residual == "(-x*y^2 - x + 2*y)/(x*y - 1)");
}

TEST_CASE("roots of one radicand meet in the finest of them, whichever stands first")
{
    Problem problem({{"x", "y"}, {}, {}, {}, {}});
    for (const char* text : {"(sqrt(1 + x^2) - ((1 + x^2)^(1/4))^2)*y", "y*((1 + x^2)^(1/4))^2 - sqrt(1 + x^2)*y",
                             "sqrt(1 + x^2)*y + (1 + x^2)^(1/6)*x - ((1 + x^2)^(1/4))^2*y - ((1 + x^2)^(1/12))^2*x"}) {
        INFO(text);
        CHECK(to_text(problem.decide(text).status) == std::string("proved"));
    }
}
