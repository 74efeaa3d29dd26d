// SPDX-License-Identifier: GPL-2.0-or-later
/// The error function in the zero decision: odd, 0 at 0, between -1 and 1, and the derivative that it is defined by.
#include "graph/calculus/differentiate.hpp"
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

const Statement half_line{{"x", "y"}, {"a"}, {}, {"y > 0"}, {}};

ProofStatus status_of(const std::string& text)
{
    Problem problem(half_line);
    return problem.decider->decide(problem.node(text)).status;
}

} // namespace

TEST_CASE("erf is odd and vanishes at 0, and nothing else is said of it")
{
    for (const char* text :
         {"erf(x) + erf(-x)", "erf(x - y) + erf(y - x)", "erf(0)", "erf(x*y) - erf(y*x)",
          "erf((x + a)^2) - erf(x^2 + 2*a*x + a^2)", "erf(x)^2 - erf(-x)^2", "erf(sin(x)^2 - 1) + erf(cos(x)^2)"}) {
        INFO(text);
        CHECK(status_of(text) == ProofStatus::proved);
    }
    for (const char* text : {"erf(x) - x", "erf(2*x) - 2*erf(x)", "erf(x)^2 - erf(x^2)", "erf(x) - erf(x + 1/10^12)",
                             "erf(1) - 842700792949715/10^15", "erf(x) - 2*x/sqrt(pi)"}) {
        INFO(text);
        CHECK(status_of(text) == ProofStatus::refuted);
    }
}

TEST_CASE("the derivative of erf is the bell curve")
{
    Problem problem(half_line);
    const NodeId argument = problem.node("x*y");
    const NodeId x[] = {problem.node("x")};
    const NodeId slope = gradient(problem.graph, problem.graph.apply(Op::erf, argument), x)[0];
    const NodeId bell = problem.node("2*y*exp(-x^2*y^2)/sqrt(pi)");
    CHECK(problem.decider->decide(problem.graph.subtract(slope, bell)).status == ProofStatus::proved);
    const NodeId curvature = gradient(problem.graph, slope, x)[0];
    const NodeId expected = problem.graph.multiply(problem.node("-2*x*y^2"), slope);
    CHECK(problem.decider->decide(problem.graph.subtract(curvature, expected)).status == ProofStatus::proved);
}

TEST_CASE("erf has the sign of its argument and stays below 1")
{
    Problem problem(half_line);
    for (const char* text : {"erf(y)", "1 - erf(x)", "1 + erf(x)", "1 - erf(x)^2", "erf(1 + x^2)", "2*y + erf(y)"}) {
        INFO(text);
        CHECK(problem.decider->proves_positive(problem.node(text)));
    }
    for (const char* text : {"erf(x)", "-erf(y)", "erf(y) - 1/2", "erf(x^2)"}) {
        INFO(text);
        CHECK_FALSE(problem.decider->proves_positive(problem.node(text)));
    }
    CHECK(problem.decider->proves_nonnegative(problem.node("erf(x^2)")));
    CHECK(problem.decider->proves_nonzero(problem.node("erf(-y)")));
}
