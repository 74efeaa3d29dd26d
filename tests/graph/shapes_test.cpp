// SPDX-License-Identifier: GPL-2.0-or-later
/// Shapes that compilers like and hand-written code has: rows without common factors, cyclic rows alike, no terms that
/// cancel.
#include "graph/core/evaluate.hpp"
#include "graph/formulas.hpp"
#include "graph/simplify/form.hpp"
#include "graph/simplify/simplify.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

std::vector<std::string> shape_texts(const Graph& g, const std::vector<NodeId>& ids)
{
    std::vector<std::string> result;
    for (const NodeId id : ids) result.push_back(to_text(g, id, 2000));
    return result;
}

/// l [m, p; q, m] z = l f, and m2 z2 with it: a row that has the factor l on both sides.
struct System {
    Graph g;
    NodeId l = g.input("l");
    NodeId m = g.input("m");
    NodeId p = g.input("p");
    NodeId f = g.input("f");
    std::vector<NodeId> solve(MatrixStructure structure)
    {
        const std::vector<NodeId> matrix{g.multiply(l, m), g.multiply(l, p), g.multiply(l, p), m};
        return g.solve(matrix, std::vector<NodeId>{g.multiply(l, f), f}, structure);
    }
};

} // namespace

TEST_CASE("a factor that a row of a system shares with its right side is divided out and reported")
{
    System x;
    const auto z = x.solve(MatrixStructure::positive_definite);
    std::vector<NodeId> divisors;
    const auto simple = simplify(x.g, z, divisors);
    CHECK(shape_texts(x.g, simple) == std::vector<std::string>{"component(solve(factor(m, p, l*p, m), f, f), 0)",
                                                               "component(solve(factor(m, p, l*p, m), f, f), 1)"});
    CHECK(divisors == std::vector<NodeId>{x.l});
    const std::map<std::string, double> at{{"l", 0.7}, {"m", 2.5}, {"p", 0.4}, {"f", -1.3}};
    const auto expected = evaluate<double>(x.g, z, at);
    const auto values = evaluate<double>(x.g, simple, at);
    for (std::size_t k = 0; k < 2; ++k) {
        REQUIRE(expected[k] != 0);
        CHECK(std::abs(values[k] - expected[k]) <= tolerance::roundoff(8) * std::abs(expected[k]));
    }
}

TEST_CASE("a symmetric matrix of order three keeps its factors, because L D L^T needs the symmetry")
{
    Graph g;
    const NodeId l = g.input("l");
    const NodeId a = g.multiply(l, g.input("a"));
    const NodeId b = g.multiply(l, g.input("b"));
    const NodeId m = g.input("m");
    const std::vector<NodeId> matrix{a, b, b, b, m, l, b, l, m};
    const auto z = g.solve(matrix, std::vector<NodeId>{b, m, m}, MatrixStructure::positive_definite);
    std::vector<NodeId> divisors;
    const auto simple = simplify(g, z, divisors);
    CHECK(divisors.empty());
    CHECK(to_text(g, simple[0]) == "component(solve(factor(l*a, l*b, l*b, l*b, m, l, l*b, l, m), l*b, m, m), 0)");
}

TEST_CASE("closed sums are opened where their terms cancel")
{
    Graph g;
    const NodeId m = g.input("m");
    const NodeId u = g.input("u");
    const NodeId v = g.input("v");
    const NodeId M = g.add(m, g.input("n"));
    const NodeId product = g.multiply(g.multiply(M, v), g.subtract(u, v));
    const std::vector<NodeId> force{g.subtract(product, g.multiply(g.multiply(M, u), v))};
    CHECK(shape_texts(g, simplify(g, force)) == std::vector<std::string>{"-v^2*(m + n)"});
}

TEST_CASE("cyclic equations have cyclic products and no subtracted sums")
{
    Graph g;
    const std::vector<NodeId> p{g.input("a"), g.input("b"), g.input("c")};
    const std::vector<NodeId> e{g.input("e"), g.input("f"), g.input("h")};
    const NodeId k = g.input("k");
    const std::vector<NodeId> d{g.input("p"), g.input("q"), g.input("r")};
    const std::vector<NodeId> x{g.input("x"), g.input("y"), g.input("z")};
    std::vector<NodeId> rows;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t l = (i + 2) % 3;
        const NodeId euler =
            g.subtract(g.multiply(g.multiply(p[j], x[j]), x[l]), g.multiply(g.multiply(p[l], x[l]), x[j]));
        const NodeId torque = g.subtract(g.multiply(e[j], d[l]), g.multiply(e[l], d[j]));
        rows.push_back(g.subtract(euler, g.multiply(k, torque)));
    }
    CHECK(shape_texts(g, simplify(g, rows)) == std::vector<std::string>{"k*(h*q - f*r) + (b - c)*y*z",
                                                                        "k*(e*r - h*p) + (c - a)*z*x",
                                                                        "k*(f*p - e*q) + (a - b)*x*y"});
}
