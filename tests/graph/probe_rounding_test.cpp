// SPDX-License-Identifier: GPL-2.0-or-later
/// Simplified forms keep the digits of what was written.
#include "graph/simplify/probe_rounding.hpp"

#include "graph/core/evaluate.hpp"
#include "graph/core/rounded_sweep.hpp"
#include "graph/formulas.hpp"
#include "graph/simplify/simplify.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

bool keeps(const Graph& g, NodeId written, NodeId form)
{
    const NodeId outputs[] = {written};
    const NodeId forms[] = {form};
    return RoundingProbe(g, outputs).keeps_digits(forms).front();
}

/// Relative error of the first output in double, against long double.
double error(const Graph& g, std::span<const NodeId> outputs, const std::map<std::string, double>& at)
{
    const std::map<std::string, long double> wide(at.begin(), at.end());
    const long double exact = evaluate<long double>(g, outputs, wide).front();
    return static_cast<double>(std::abs(evaluate<double>(g, outputs, at).front() - exact) / std::abs(exact));
}

} // namespace

TEST_CASE("a square of a difference is not a sum of squares, a product with a difference not a difference of products")
{
    Graph g;
    const NodeId a = g.input("a");
    const NodeId b = g.input("b");
    const NodeId c = g.input("c");
    const NodeId d = g.subtract(a, b);
    const NodeId twice = g.multiply(g.constant(2), g.multiply(a, b));
    CHECK_FALSE(keeps(g, g.power(d, 2), g.add(g.subtract(g.power(a, 2), twice), g.power(b, 2))));
    CHECK_FALSE(keeps(g, g.multiply(c, d), g.subtract(g.multiply(c, a), g.multiply(c, b))));
    CHECK_FALSE(keeps(g, g.multiply(d, g.add(a, b)), g.subtract(g.power(a, 2), g.power(b, 2))));
    CHECK(keeps(g, g.subtract(g.multiply(c, a), g.multiply(c, b)), g.multiply(c, d)));
    CHECK(keeps(g, g.add(g.multiply(a, c), g.multiply(b, c)), g.multiply(g.add(a, b), c)));
    CHECK(keeps(g, g.divide(a, b), g.multiply(a, g.divide(g.constant(1), b))));
}

TEST_CASE("angles and roots are no exception: one minus a cosine, differences of roots")
{
    Graph g;
    const NodeId q = g.input("q");
    const NodeId half = g.apply(Op::sin, g.divide(q, g.constant(2)));
    const NodeId careful = g.multiply(g.constant(2), g.power(half, 2));
    const NodeId a = g.add(q, g.input("h"));
    const NodeId sum = g.add(g.apply(Op::sqrt, a), g.apply(Op::sqrt, q));
    CHECK(keeps(g, g.subtract(g.constant(1), g.apply(Op::cos, q)), careful));
    CHECK(keeps(g, g.divide(g.input("h"), sum), g.divide(g.input("h"), sum)));
    const NodeId difference = g.subtract(g.input("x"), g.input("y"));
    const NodeId careless = g.subtract(g.power(g.input("x"), 3), g.power(g.input("y"), 3));
    const NodeId rest =
        g.add(g.add(g.power(g.input("x"), 2), g.multiply(g.input("x"), g.input("y"))), g.power(g.input("y"), 2));
    CHECK_FALSE(keeps(g, g.multiply(difference, rest), careless));
}

TEST_CASE("simplified outputs are as accurate near a cancellation as the written ones, in double")
{
    Graph g;
    const NodeId x = g.input("x");
    const NodeId y = g.input("y");
    const NodeId k = g.input("k");
    const NodeId d = g.subtract(x, y);
    // Sums of these tempt the portfolio: like terms appear when everything is multiplied out.
    const std::vector<NodeId> written{g.add(g.multiply(k, g.power(d, 2)), g.multiply(k, g.multiply(d, g.power(d, 3)))),
                                      g.multiply(g.multiply(d, d), g.add(x, y)),
                                      g.multiply(g.subtract(g.constant(Rational(-1, 2)), y), g.multiply(k, x))};
    const auto simple = simplify(g, written);
    CHECK(count_operations(g, simple).weight <= count_operations(g, written).weight);
    for (const double distance : {1e-3, 1e-6, 1e-9, 1e-12})
        for (std::size_t output = 0; output < written.size(); ++output) {
            const double value = output == 2 ? -0.5 + distance : 1.1 + distance;
            const std::map<std::string, double> at{{"x", 1.1}, {"y", value}, {"k", 0.7}};
            const NodeId one[] = {simple[output]};
            INFO("output " << output << ", distance " << distance);
            CHECK(error(g, one, at) < 2e-15);
        }
}

TEST_CASE("the 24 bits are rounded to nearest, and solutions of linear systems are swept too")
{
    CHECK(to_24_bits(1 + 0x1p-24) == 1.0);
    CHECK(to_24_bits(1 + 0x1.8p-24) == 1 + 0x1p-23);
    CHECK(to_24_bits(-1e-200) == Approx(-1e-200).epsilon(6e-8));
    Graph g;
    const std::vector<NodeId> matrix{g.input("a"), g.constant(1), g.constant(1), g.constant(3)};
    const std::vector<NodeId> right{g.constant(5), g.constant(10)};
    const auto z = g.solve(matrix, right, MatrixStructure::general);
    const auto nodes = reachable(g, z);
    const auto values = sweep(g, nodes, {2}, true);
    CHECK(values[z[0]] == Approx(1).epsilon(1e-6));
    CHECK(values[z[1]] == Approx(3).epsilon(1e-6));
    CHECK(std::isnan(sweep(g, nodes, {1.0 / 3.0}, false)[z[0]])); // singular, exactly so after rounding
    const auto singular = sweep(g, reachable(g, z), {0}, false);
    CHECK(singular[z[0]] == Approx(-5).epsilon(1e-12)); // [[0, 1], [1, 3]]: rows are exchanged
}

TEST_CASE("a probe of a large graph is bounded in time and a form of itself passes")
{
    Graph g;
    NodeId sum = g.input("x");
    for (int k = 0; k < 3000; ++k)
        sum = g.add(g.multiply(sum, g.input("y" + std::to_string(k % 50))), g.input("z" + std::to_string(k % 40)));
    CHECK(keeps(g, sum, sum));
}
