// SPDX-License-Identifier: GPL-2.0-or-later
/// Newton's method of the interpreter: the verdicts of the compiled one on unknowns of different sizes, beside a
/// singularity, and where there is no root.
#include "graph/unknowns/solve_unknowns.hpp"

#include "text/diagnostic.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace lagen;

namespace {

/// One block over the unknowns a and b, from (0, 0).
struct Pair {
    Graph graph;
    NodeId a = graph.input("a"), b = graph.input("b"), p = graph.input("p"), q = graph.input("q");

    template <class Scalar>
    std::map<std::string, Scalar> solve(std::vector<NodeId> residuals, Scalar at_p, Scalar at_q)
    {
        const NodeId zero = graph.constant(0);
        const ImplicitBlock block = implicit_block(graph, "velocity", "y with dL/dy^a = mu_a.", {a, b},
                                                   std::move(residuals), {zero, zero}, MatrixStructure::symmetric);
        std::map<std::string, Scalar> inputs{{"p", at_p}, {"q", at_q}};
        solve_unknowns<Scalar>(graph, {&block, 1}, inputs);
        return inputs;
    }
};

template <class Scalar>
void check_apart(Scalar p)
{
    Pair pair;
    Graph& g = pair.graph;
    const auto found = pair.solve<Scalar>(
        {g.subtract(pair.a, pair.p), g.subtract(g.add(pair.b, g.power(pair.b, 3)), pair.q)}, p, Scalar(2));
    CHECK(found.at("a") == p);
    CHECK(found.at("b") == 1);
}

} // namespace

TEST_CASE("The interpreter finds an unknown to its own last places beside one that is larger by any factor")
{
    for (const double p : {1.0, 1e10, 1e15, 1e16, 1e20, 1e100}) check_apart<double>(p);
    for (const long double p : {1.0L, 1e18L, 1e19L, 1e20L, 1e100L}) check_apart<long double>(p);
}

TEST_CASE("The interpreter finds a velocity beside the speed of light to its last places, or none")
{
    Pair pair;
    Graph& g = pair.graph;
    // p = a / sqrt(1 - a^2 - b^2), q = b / sqrt(1 - a^2 - b^2)
    const NodeId room = g.subtract(g.subtract(g.constant(1), g.power(pair.a, 2)), g.power(pair.b, 2));
    const NodeId mass = g.divide(g.constant(1), g.apply(Op::sqrt, room));
    const std::vector<NodeId> residuals{g.subtract(g.multiply(pair.a, mass), pair.p),
                                        g.subtract(g.multiply(pair.b, mass), pair.q)};
    for (const double p : {0.5, 3.0, 100.0, 1e4, 1e6}) {
        const auto found = pair.solve<double>(residuals, p, -p / 2);
        const long double all = std::sqrt(1.0L + 1.25L * p * p);
        CHECK(std::abs(found.at("a") - p / all) <= 2 * std::numeric_limits<double>::epsilon());
        CHECK(std::abs(found.at("b") + p / 2 / all) <= 2 * std::numeric_limits<double>::epsilon());
    }
    CHECK_THROWS_WITH(pair.solve<double>(residuals, 1e12, 0),
                      "error: Newton's method finds no velocity: y with dL/dy^a = mu_a.");
}

TEST_CASE("The interpreter finds no root where there is none")
{
    Pair pair;
    Graph& g = pair.graph;
    const NodeId fold = g.subtract(g.subtract(g.power(pair.a, 3), pair.a), pair.p); // of v^3 - v at 0.3849..
    const std::vector<NodeId> residuals{fold, g.subtract(pair.b, pair.q)};
    CHECK(std::abs(pair.solve<double>(residuals, 0.384, 1).at("a") + 0.55440037453175306) < 1e-14);
    for (const double p : {0.39, 0.4, 0.5})
        CHECK_THROWS_WITH(pair.solve<double>(residuals, p, 1),
                          "error: Newton's method finds no velocity: y with dL/dy^a = mu_a.");
}
