// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_literal.hpp"

#include "emit/order_body.hpp"
#include "emit/spell.hpp"
#include "emit/unroll_solve.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace lagen;

TEST_CASE("literals are exact in every scalar", "[emit]")
{
    CHECK(print_literal(2).text == "S(2)");
    CHECK(print_literal(-3).text == "S(-3)");
    CHECK(print_literal(Rational(1, 2)).text == "S(0.5)");
    CHECK(print_literal(Rational(1, 10)).text == "S(1) / S(10)");
    CHECK(print_literal(Rational("4294967296")).text == "S(4294967296.0)");
    CHECK(print_literal(Rational("9007199254740993")).text == "(S(9007199254740992.0) + S(1.0))");
    CHECK(print_literal(Rational("1/10000000000000000000000000000000000000000")).text ==
          "(S(1e-40) + S(7.070712060011986e-57))");
}

namespace {

std::string spelled(Graph& graph, NodeId id)
{
    NodeExpressions expressions(graph);
    for (const NodeId input : graph.inputs()) expressions.name(input, variable(graph.input_name(input)));
    return spell(expressions(id)).text;
}

} // namespace

TEST_CASE("expressions have the fewest parentheses and no sign behind a sign", "[emit]")
{
    Graph g;
    const NodeId a = g.input("a");
    const NodeId b = g.input("b");
    const NodeId c = g.input("c");
    CHECK(spelled(g, g.add(a, g.multiply(b, c))) == "a + b * c");
    CHECK(spelled(g, g.subtract(a, g.add(b, c))) == "a - (b + c)");
    CHECK(spelled(g, g.divide(a, g.multiply(b, c))) == "a / (b * c)");
    CHECK(spelled(g, g.add(a, g.multiply(g.constant(-2), b))) == "a - S(2) * b");
    CHECK(spelled(g, g.add(g.negate(a), b)) == "b - a");
    CHECK(spelled(g, g.power(a, 3)) == "a * a * a");
    CHECK(spelled(g, g.power(a, -2)) == "S(1) / (a * a)");
    CHECK(spelled(g, g.apply(Op::real_power, a, g.constant(Rational(-3, 2)))) ==
          "S(1) / (sqrt(a) * sqrt(a) * sqrt(a))");
    CHECK(spelled(g, g.apply(Op::real_power, a, b)) == "pow(a, b)");
    CHECK(spelled(g, g.select(g.apply(Op::less, a, b), a, g.apply(Op::sign, c))) ==
          "select(a < b, a, select(c > S(0), S(1), select(c < S(0), S(-1), S(0))))");
    CHECK(spelled(g, g.apply(Op::maximum, a, b)) == "select(a > b, a, b)");
}

TEST_CASE("a long chain of single uses is cut into named terms", "[emit]")
{
    Graph g;
    NodeId sum = g.input("x");
    for (int k = 1; k <= 100000; ++k) sum = g.apply(Op::sqrt, g.add(sum, g.input("x")));
    const NodeId outputs[] = {sum};
    const BodyPlan plan = plan_body(g, outputs);
    CHECK(order_body(g, plan, {outputs, {}, {}}).size() >= 100000 / 16);
}

TEST_CASE("elimination by least degree leaves the hub of an arrow to the end", "[emit]")
{
    const std::vector<std::vector<bool>> arrow{
        {true, true, true, true}, {true, true, false, false}, {true, false, true, false}, {true, false, false, true}};
    CHECK(least_degree_order(arrow) == std::vector<std::size_t>{1, 2, 0, 3});
}
