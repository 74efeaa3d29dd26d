// SPDX-License-Identifier: GPL-2.0-or-later
/// Derivatives against central differences, forward against reverse, and higher orders.
#include "graph/calculus/differentiate.hpp"

#include "graph/core/evaluate.hpp"
#include "graph/core/operators.hpp"
#include "graph/formulas.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using Values = std::map<std::string, double>;

namespace {

double value(const Graph& g, NodeId id, const Values& at)
{
    return evaluate<double>(g, std::vector<NodeId>{id}, at)[0];
}

double central_difference(const Graph& g, NodeId f, const std::string& name, Values at)
{
    const double h = 6e-6;
    const double middle = at[name];
    at[name] = middle + h;
    const double right = value(g, f, at);
    at[name] = middle - h;
    return (right - value(g, f, at)) / (2 * h);
}

/// Both modes against differences, for d f / d x and d f / d y.
void check_derivatives(Graph& g, NodeId f, const Values& at)
{
    const std::vector<NodeId> inputs{g.input("x"), g.input("y")};
    const auto reverse = gradient(g, f, inputs);
    for (std::size_t k = 0; k < 2; ++k) {
        const std::pair<NodeId, NodeId> seed[] = {{inputs[k], g.constant(1)}};
        const NodeId forward = directional(g, std::vector<NodeId>{f}, seed)[0];
        const double difference = central_difference(g, f, k == 0 ? "x" : "y", at);
        INFO(to_text(g, f) << " by " << (k == 0 ? "x" : "y"));
        CHECK(value(g, forward, at) == Approx(difference).epsilon(1e2 * tolerance::difference).margin(1e-9));
        CHECK(value(g, reverse[k], at) == Approx(value(g, forward, at)).epsilon(tolerance::roundoff(64)).margin(1e-15));
    }
}

} // namespace

TEST_CASE("the derivative of every operation agrees with central differences, forward and reverse")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    const Values at{{"x", 0.37}, {"y", 0.61}};
    const NodeId inner = g.multiply(x, y); // so that the chain rule is under test as well
    std::size_t tested = 0;
    for (const Operator& entry : operator_table()) {
        if (entry.contribution == nullptr) continue;
        ++tested;
        switch (entry.arity) {
        case 1:
            check_derivatives(g,
                              entry.op == Op::power     ? g.power(g.add(inner, y), -3)
                              : entry.op == Op::stumpff ? g.stumpff(3, inner)
                                                        : g.apply(entry.op, inner),
                              at);
            break;
        case 2: check_derivatives(g, g.apply(entry.op, g.add(inner, x), y), at); break;
        default: check_derivatives(g, g.select(g.apply(Op::less, x, y), g.power(inner, 2), x), at);
        }
    }
    CHECK(tested == 33);
}

TEST_CASE("a solve differentiates on its own factorisation, symmetric and general")
{
    for (const auto structure : {MatrixStructure::general, MatrixStructure::positive_definite}) {
        Graph g;
        const NodeId x = g.input("x");
        const NodeId y = g.input("y");
        const bool general = structure == MatrixStructure::general;
        const std::vector<NodeId> matrix{g.add(g.constant(2), g.power(x, 2)), g.multiply(x, y),
                                         general ? g.apply(Op::sin, x) : g.multiply(x, y), g.add(g.constant(3), y)};
        const auto z = g.solve(matrix, std::vector<NodeId>{g.apply(Op::cos, y), x}, structure);
        check_derivatives(g, z[0], {{"x", 0.4}, {"y", 0.7}});
        check_derivatives(g, g.multiply(z[0], z[1]), {{"x", 0.4}, {"y", 0.7}});
        const std::pair<NodeId, NodeId> seed[] = {{x, g.constant(1)}};
        const auto dz = directional(g, z, seed);
        CHECK(g.operands(g.operands(dz[0])[0])[0] == g.operands(g.operands(z[0])[0])[0]);
    }
}

TEST_CASE("third derivatives by nesting are exact")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    // f = x^4 y^3 + x^2 / (1 + y):  f_xxy = 36 x^2 y^2 - 2 / (1 + y)^2
    const NodeId f = g.add(g.multiply(g.power(x, 4), g.power(y, 3)), g.divide(g.power(x, 2), g.add(g.constant(1), y)));
    const NodeId first = gradient(g, f, std::vector<NodeId>{x})[0];
    const NodeId second = gradient(g, first, std::vector<NodeId>{x})[0];
    const NodeId third = gradient(g, second, std::vector<NodeId>{y})[0];
    const auto exact = evaluate_exactly(g, std::vector<NodeId>{third}, {{"x", Rational(2, 3)}, {"y", Rational(1, 2)}});
    REQUIRE(exact.size() == 1);
    CHECK(exact[0] == Rational(4) - Rational(8, 9));
}

TEST_CASE("forward and reverse agree exactly on random rational expressions")
{
    test::Random random(7);
    int regular = 0;
    for (int round = 0; round < 60; ++round) {
        Graph g;
        const NodeId f = test::random_rational(g, random, 12, true);
        const std::vector<NodeId> inputs{g.input("x"), g.input("y"), g.input("z")};
        auto both = gradient(g, f, inputs);
        const auto rows = jacobian(g, std::vector<NodeId>{f}, inputs);
        both.insert(both.end(), rows[0].begin(), rows[0].end());
        const auto values =
            evaluate_exactly(g, both, {{"x", Rational(1, 3)}, {"y", Rational(-2, 5)}, {"z", Rational(3, 7)}});
        if (values.empty()) continue;
        ++regular;
        for (std::size_t k = 0; k < 3; ++k) CHECK(values[k] == values[k + 3]);
    }
    CHECK(regular > 50);
}

TEST_CASE("derivatives of shared expressions grow linearly")
{
    Graph g;
    const NodeId x = g.input("x");
    NodeId e = x;
    for (int k = 0; k < 40; ++k) e = g.multiply(g.apply(Op::sin, e), g.apply(Op::cos, e));
    const std::size_t before = g.size();
    const auto slope = gradient(g, e, std::vector<NodeId>{x});
    CHECK(g.size() < before + 40 * 8);
    CHECK(value(g, slope[0], {{"x", 0.3}}) == Approx(central_difference(g, e, "x", {{"x", 0.3}})).epsilon(1e-7));
}

TEST_CASE("substitution is simultaneous and simplifies by the local rules")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    const std::pair<NodeId, NodeId> swap[] = {{x, y}, {y, x}};
    const std::vector<NodeId> f{g.subtract(g.multiply(x, g.apply(Op::sin, y)), x)};
    CHECK(to_text(g, substitute(g, f, swap)[0]) == "y*sin(x) - y");
    const std::pair<NodeId, NodeId> zero[] = {{y, g.constant(0)}};
    CHECK(to_text(g, substitute(g, f, zero)[0]) == "-x");
}
