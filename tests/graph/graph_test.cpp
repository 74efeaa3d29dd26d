// SPDX-License-Identifier: GPL-2.0-or-later
/// Hash-consing, local rules, bounds and texts of the graph.
#include "graph/core/graph.hpp"

#include "graph/core/evaluate.hpp"
#include "graph/core/operators.hpp"
#include "graph/core/schedule.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

TEST_CASE("equal expressions are the same node, whatever the order of commutative operands")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    CHECK(g.input("x") == x);
    CHECK(g.constant(Rational(2, 4)) == g.constant(Rational(1, 2)));
    CHECK(g.add(x, y) == g.add(y, x));
    CHECK(g.multiply(x, y) == g.multiply(y, x));
    CHECK(g.subtract(x, y) != g.subtract(y, x));
    CHECK(g.apply(Op::sin, g.add(x, y)) == g.apply(Op::sin, g.add(y, x)));
    const std::size_t size = g.size();
    CHECK(g.divide(g.add(x, y), x) == g.divide(g.add(y, x), x));
    CHECK(g.size() == size + 1);
}

TEST_CASE("local rules fold what is certain and nothing else")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    const NodeId zero = g.constant(0);
    const NodeId one = g.constant(1);
    CHECK(g.add(x, zero) == x);
    CHECK(g.multiply(one, x) == x);
    CHECK(g.multiply(zero, x) == zero);
    CHECK(g.subtract(x, x) == zero);
    CHECK(g.divide(x, x) == one);
    CHECK(g.add(x, x) == g.multiply(g.constant(2), x));
    CHECK(g.multiply(x, x) == g.power(x, 2));
    CHECK(g.negate(g.negate(x)) == x);
    CHECK(g.negate(g.subtract(x, y)) == g.subtract(y, x));
    CHECK(g.multiply(g.negate(x), y) == g.negate(g.multiply(x, y)));
    CHECK(g.add(x, g.negate(y)) == g.subtract(x, y));
    CHECK(g.power(g.negate(x), 3) == g.negate(g.power(x, 3)));
    CHECK(g.apply(Op::sqrt, g.power(x, 2)) == g.apply(Op::abs, x));
    CHECK(g.divide(g.apply(Op::sinh, x), g.apply(Op::cosh, x)) == g.apply(Op::tanh, x));
    CHECK(g.power(g.power(x, 2), -3) == g.power(x, -6));
    CHECK(g.power(g.apply(Op::sqrt, x), 4) == g.power(x, 2));
    CHECK(g.apply(Op::real_power, x, g.constant(Rational(3, 2))) == g.power(g.apply(Op::sqrt, x), 3));
    CHECK(g.value(g.apply(Op::sqrt, g.constant(Rational(9, 4)))) == Rational(3, 2));
    CHECK(g.value(g.power(g.constant(Rational(-2, 3)), -3)) == Rational(-27, 8));
    CHECK(g.op(g.apply(Op::sqrt, g.constant(2))) == Op::sqrt);
    CHECK(to_text(g, g.multiply(x, g.add(x, y))) == "x*(x + y)");
}

TEST_CASE("a division by the constant zero is refused")
{
    Graph g;
    const NodeId x = g.input("x");
    CHECK_THROWS_AS(g.divide(x, g.subtract(x, x)), MathematicsError);
    CHECK_THROWS_AS(g.power(g.constant(0), -1), MathematicsError);
}

TEST_CASE("texts have the fewest parentheses and are cut at the limit")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    CHECK(to_text(g, g.subtract(x, g.subtract(y, g.constant(1)))) == "x - (y - 1)");
    CHECK(to_text(g, g.divide(x, g.multiply(x, y))) == "x/(x*y)");
    CHECK(to_text(g, g.power(g.add(x, y), -2)) == "(x + y)^-2");
    CHECK(to_text(g, g.apply(Op::atan2, y, g.negate(x))) == "atan2(y, -x)");
    CHECK(to_text(g, g.select(g.apply(Op::less, x, y), x, g.pi())) == "if(x < y, x, pi)");
    CHECK(to_text(g, g.apply(Op::sin, g.add(x, y)), 5) == "sin(x...");
}

TEST_CASE("a linear system falls apart into the blocks of its pattern")
{
    Graph g;
    const NodeId zero = g.constant(0);
    const NodeId a = g.input("a");
    const NodeId b = g.input("b");
    const NodeId c = g.input("c");
    const NodeId u = g.input("u");
    const NodeId v = g.input("v");
    const NodeId w = g.input("w");
    // Unknowns 0 and 2 are coupled, 1 stands alone.
    const NodeId matrix[] = {a, zero, b, zero, c, zero, b, zero, a};
    const NodeId right[] = {u, v, w};
    const auto z = g.solve(matrix, right, MatrixStructure::positive_definite);
    CHECK(z[1] == g.divide(v, c));
    CHECK(to_text(g, z[0]) == "component(solve(factor(a, b, b, a), u, w), 0)");
    CHECK(to_text(g, z[2]) == "component(solve(factor(a, b, b, a), u, w), 1)");
    CHECK(g.payload(g.operands(g.operands(z[0])[0])[0]) ==
          static_cast<std::uint32_t>(MatrixStructure::positive_definite));
    const NodeId crossed[] = {zero, a, b, zero};
    const auto swapped = g.solve(crossed, std::vector<NodeId>{u, v}, MatrixStructure::general);
    CHECK(swapped == std::vector<NodeId>{g.divide(v, b), g.divide(u, a)});
}

TEST_CASE("the interpreter solves linear systems and says NaN where they are singular")
{
    Graph g;
    std::vector<NodeId> matrix;
    for (const char* name : {"a", "b", "c", "d"}) matrix.push_back(g.input(name));
    const auto z = g.solve(matrix, std::vector<NodeId>{g.input("u"), g.input("v")}, MatrixStructure::general);
    const std::map<std::string, Rational> exact{{"a", 0}, {"b", 2}, {"c", 3}, {"d", 4}, {"u", 6}, {"v", 5}};
    CHECK(evaluate_exactly(g, z, exact) == std::vector<Rational>{Rational(-7, 3), Rational(3)});
    std::map<std::string, double> values;
    for (const auto& [name, value] : exact) values[name] = value.get_d();
    CHECK(evaluate<double>(g, z, values)[0] == Approx(-7.0 / 3.0));
    CHECK(evaluate<double>(g, z, values)[1] == Approx(3.0));
    values["c"] = 0;
    CHECK(std::isnan(evaluate<double>(g, z, values)[0]));
    auto singular = exact;
    singular["c"] = 0;
    CHECK(evaluate_exactly(g, z, singular).empty());
}

TEST_CASE("constants are rounded to nearest in every scalar")
{
    Graph g;
    const std::vector<NodeId> outputs{g.constant(Rational(1, 10)), g.pi()};
    CHECK(evaluate<double>(g, outputs, {})[0] == 0.1);
    CHECK(evaluate<float>(g, outputs, {})[0] == 0.1F);
    CHECK(evaluate<long double>(g, outputs, {})[0] == 0.1L);
    CHECK(evaluate<double>(g, outputs, {})[1] == 3.141592653589793);
}

TEST_CASE("a chain of a million nodes is walked without recursion")
{
    Graph g;
    const NodeId x = g.input("x");
    NodeId chain = x;
    for (int k = 0; k < 1'000'000; ++k) chain = k % 2 == 0 ? g.multiply(chain, x) : g.add(chain, x);
    const NodeId roots[] = {chain};
    CHECK(reachable(g, roots).size() > 900'000);
    CHECK(evaluate<double>(g, roots, {{"x", 0.5}})[0] == 1.0);
    CHECK(to_text(g, chain, 10).size() == 13);
    CHECK(schedule(g, roots).temporaries.empty());
}

TEST_CASE("constants that outgrow the bound stay operations")
{
    Graph g;
    NodeId x = g.constant(3);
    for (int k = 0; k < 40; ++k) x = g.multiply(x, x);
    CHECK(g.op(x) == Op::power);
    CHECK(g.size() < 100);
    CHECK(evaluate_exactly(g, std::vector<NodeId>{x}, {}).empty());
}

TEST_CASE("a schedule names what is used twice, operands first, and every operand of a solve")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    const NodeId shared = g.apply(Op::sin, g.add(x, y));
    const NodeId once = g.multiply(shared, x);
    const std::vector<NodeId> outputs{g.add(shared, g.constant(1)), once};
    const Schedule plan = schedule(g, outputs);
    CHECK(plan.temporaries == std::vector<NodeId>{shared});
    CHECK(plan.uses[shared] == 2);
    CHECK(plan.uses[once] == 1);
    const std::vector<NodeId> matrix{x, y, y, once};
    const auto z = g.solve(matrix, std::vector<NodeId>{y, x}, MatrixStructure::symmetric);
    const NodeId solve = g.operands(z[0])[0];
    const Schedule linear = schedule(g, z);
    CHECK(linear.temporaries == std::vector<NodeId>{once, g.operands(solve)[0], solve});
}

TEST_CASE("the operator table has one record an operation, in order")
{
    const auto table = operator_table();
    REQUIRE(table.size() == static_cast<std::size_t>(Op::component) + 1);
    for (std::size_t k = 0; k < table.size(); ++k) CHECK(static_cast<std::size_t>(table[k].op) == k);
    CHECK(power_multiplications(7) == 4);
    CHECK(power_multiplications(8) == 3);
}
