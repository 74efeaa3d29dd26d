// SPDX-License-Identifier: GPL-2.0-or-later
/// The zero decision: signs.
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

const Statement pendulum{
    {"a", "b", "x", "y"}, {"m", "n", "l"}, {}, {"m > 0", "n > 0", "l > 0", "y > -2", "x - y > 0"}, {}};

} // namespace

TEST_CASE("positivity on the whole domain is shown by exact algebra")
{
    const char* positive[] = {"m",
                              "m*l^2",
                              "m + n",
                              "1/m - 1/(m + n)",
                              "y + 2",
                              "y + 3",
                              "x - y + m",
                              "x^2 + 1",
                              "exp(x)",
                              "sqrt(m)",
                              "abs(x) + 1",
                              "2 + cos(a)",
                              "m + n*(1 - cos(a))",
                              "m + n*sin(a)^2",
                              "(m + n)*l^2*n*l^2 - (n*l*l*cos(a))^2",
                              "(m + n)*n - n^2*cos(a - b)^2",
                              "cosh(x)",
                              "cos(a)^2 + sin(a)^2",
                              "pi - 3",
                              "(x - y)*m",
                              "sin(a)^2 + 2*cos(a)^2"};
    for (const char* text : positive) {
        Problem problem(pendulum);
        INFO(text);
        CHECK(problem.decider->proves_positive(problem.node(text)));
        CHECK(problem.decider->proves_nonzero(problem.node(text)));
        CHECK_FALSE(problem.decider->proves_positive(problem.node("-(" + std::string(text) + ")")));
        CHECK(problem.decider->proves_nonzero(problem.node("-(" + std::string(text) + ")")));
    }
}

TEST_CASE("what may vanish or change its sign is never called positive")
{
    const char* open[] = {"a",
                          "x^2",
                          "y + 1",
                          "m - n",
                          "1 + cos(a)",
                          "sin(a)^2",
                          "abs(x)",
                          "x",
                          "m*x",
                          "sqrt(x^2)",
                          "y",
                          "1 - cos(a)^2",
                          "m - m*sin(a)",
                          "(m - n)^2",
                          "0",
                          "x/m",
                          "log(m)",
                          "sinh(x)",
                          "(m + n)*n - n^2*cos(a - b)^2 - m*n"};
    for (const char* text : open) {
        Problem problem(pendulum);
        INFO(text);
        CHECK_FALSE(problem.decider->proves_positive(problem.node(text)));
        CHECK_FALSE(problem.decider->proves_nonzero(problem.node(text)));
    }
}

TEST_CASE("an inequation of the domain makes a product nonzero but not positive")
{
    Problem problem({{"x", "y"}, {}, {}, {"x != 0", "y < 0"}, {}});
    const NodeId node = problem.node("x*y^3");
    CHECK(problem.decider->proves_nonzero(node));
    CHECK_FALSE(problem.decider->proves_positive(node));
    CHECK(problem.decider->proves_positive(problem.node("-x^2*y")));
}

TEST_CASE("signs on a constraint set use the constraint")
{
    Problem problem({{"g1", "g2", "g3"}, {}, {"g1^2 + g2^2 + g3^2 - 1"}, {}, {}});
    CHECK(problem.decider->proves_positive(problem.node("g1^2 + g2^2 + g3^2")));
    CHECK_FALSE(problem.decider->proves_positive(problem.node("g1^2 + g2^2")));
}

TEST_CASE("a sign that holds beside the constraints is not lost where one of them is put in")
{
    Problem problem({{"x", "y", "z"}, {}, {"(9/4*x)^2 + (5/4*y)^2 + (3/4*z)^2 - 1"}, {}, {}});
    CHECK(problem.decider->proves_positive(problem.node("2 + z^2")));
    CHECK(problem.decider->proves_positive(problem.node("3 - (9/4*x)^2 - (5/4*y)^2 - (3/4*z)^2")));
    CHECK_FALSE(problem.decider->proves_nonnegative(problem.node("z + z^2")));
}

TEST_CASE("logarithms and exponentials lie between those of the ends of their arguments")
{
    Problem problem({{"x"}, {"a"}, {}, {"a > 2", "a < 3"}, {}});
    CHECK(problem.decider->proves_positive(problem.node("log(3 + x^2) - 1")));
    CHECK_FALSE(problem.decider->proves_positive(problem.node("log(3 + x^2) - 11/10")));
    CHECK(problem.decider->proves_positive(problem.node("11/10 - log(a)")));
    CHECK_FALSE(problem.decider->proves_positive(problem.node("1 - log(a)")));
    CHECK(problem.decider->proves_positive(problem.node("exp(a) - 7")));
    CHECK_FALSE(problem.decider->proves_positive(problem.node("exp(a) - 8")));
    CHECK(problem.decider->proves_positive(problem.node("exp(5 + x^2) - 100")));
    CHECK_FALSE(problem.decider->proves_nonzero(problem.node("exp(10^9*x + 10^30) - 1")));
}
