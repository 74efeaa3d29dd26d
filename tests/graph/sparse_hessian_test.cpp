// SPDX-License-Identifier: GPL-2.0-or-later
/// Solving with W = d2L/dy2 through the terms of L, beside the dense factorisation.
#include "graph/elimination/sparse_hessian.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/simplify/simplify.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace lagen;

namespace {

enum class Measured { absolute, relative };

/// The kinetic energy of a chain of n masses: L = sum_k m_k (dx_k^2 + dy_k^2) / 2 with sums dx_k, dy_k along the chain;
/// and W z = b with right sides b_1, b_2, ... .
struct Chain {
    Chain(Graph& graph, std::size_t n, Measured angles)
    {
        const NodeId zero = graph.constant(0);
        NodeId angle = zero, rate = zero, dx = zero, dy = zero, twice = zero;
        for (std::size_t k = 0; k < n; ++k) {
            const std::string index = std::to_string(k + 1);
            y.push_back(graph.input("y" + index));
            right.push_back(graph.input("b" + index));
            const NodeId a = graph.input("a" + index);
            angle = angles == Measured::relative ? graph.add(angle, a) : a;
            rate = angles == Measured::relative ? graph.add(rate, y.back()) : y.back();
            const NodeId length = graph.input("l" + index);
            dx = graph.add(dx, graph.multiply(graph.multiply(length, graph.apply(Op::cos, angle)), rate));
            dy = graph.add(dy, graph.multiply(graph.multiply(length, graph.apply(Op::sin, angle)), rate));
            const NodeId square = graph.add(graph.power(dx, 2), graph.power(dy, 2));
            twice = graph.add(twice, graph.multiply(graph.input("m" + index), square));
        }
        lagrangian = graph.divide(twice, graph.constant(2));
        const std::vector<NodeId> momenta = gradient(graph, lagrangian, y);
        for (const std::vector<NodeId>& row : jacobian(graph, momenta, y)) W.insert(W.end(), row.begin(), row.end());
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < i; ++j) W[i * n + j] = W[j * n + i];
        dense = graph.solve(W, right, MatrixStructure::positive_definite);
    }

    std::vector<NodeId> y;
    std::vector<NodeId> right;
    std::vector<NodeId> W;
    std::vector<NodeId> dense;
    NodeId lagrangian = 0;
};

template <class Scalar>
std::map<std::string, Scalar> point(const Graph& graph, unsigned seed)
{
    std::mt19937 random(seed);
    std::map<std::string, Scalar> at;
    for (const NodeId input : graph.inputs()) {
        const std::string& name = graph.input_name(input);
        const double part = static_cast<double>(random()) / 4294967296.0;
        const bool positive = name[0] == 'm' || name[0] == 'l';
        at[name] = static_cast<Scalar>(positive ? 0.5 + part : 6 * part - 3);
    }
    return at;
}

/// Largest error of the nodes in double, relative to the largest exact value.
double error(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<NodeId>& reference, unsigned seed)
{
    const auto exact = evaluate<long double>(graph, reference, point<long double>(graph, seed));
    const auto found = evaluate<double>(graph, nodes, point<double>(graph, seed));
    long double size = 0;
    long double worst = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        size = std::max(size, std::abs(exact[k]));
        worst = std::max(worst, std::abs(exact[k] - static_cast<long double>(found[k])));
    }
    REQUIRE(size > 0);
    return static_cast<double>(worst / size);
}

double weight(const Graph& graph, const std::vector<NodeId>& nodes)
{
    return count_operations(graph, nodes).weight;
}

} // namespace

TEST_CASE("a chain of n links has n products of terms a coordinate, whatever the length of its sums")
{
    Graph graph;
    const Chain chain(graph, 4, Measured::absolute);
    const auto hessian = read_hessian(graph, chain.lagrangian, chain.y);
    REQUIRE(hessian.has_value());
    CHECK(hessian->order == 4);
    CHECK(hessian->entries.size() == 8);             // m_k dx_k^2 and m_k dy_k^2
    CHECK(hessian->definitions.size() == 4 + 8 + 6); // y_k, its two multiples, the sums of two and more
}

TEST_CASE("what is not quadratic in the variables has no sparse Hessian")
{
    Graph graph;
    const NodeId x = graph.input("x");
    const NodeId y[] = {graph.input("y1"), graph.input("y2")};
    const NodeId square = graph.add(graph.power(y[0], 2), graph.power(y[1], 2));
    CHECK(read_hessian(graph, graph.multiply(x, square), y).has_value());
    CHECK(!read_hessian(graph, graph.multiply(y[0], square), y).has_value());
    CHECK(!read_hessian(graph, graph.apply(Op::sqrt, square), y).has_value());
    CHECK(!read_hessian(graph, graph.divide(square, graph.add(x, y[0])), y).has_value());
    CHECK(!read_hessian(graph, graph.add(x, y[0]), y).has_value());
    CHECK(!read_hessian(graph, graph.power(y[0], 3), y).has_value());
}

TEST_CASE("the elimination solves the system that the matrix stands for, exactly")
{
    Graph graph;
    const NodeId m = graph.input("m");
    const NodeId c = graph.input("c");
    const NodeId y[] = {graph.input("y1"), graph.input("y2"), graph.input("y3")};
    // L = (m u^2 + 3 v^2 + u v)/2 + y2 y3 + 5 y3^2, u = c y1 - y2, v = (u + y3)/2
    const NodeId u = graph.subtract(graph.multiply(c, y[0]), y[1]);
    const NodeId v = graph.divide(graph.add(u, y[2]), graph.constant(2));
    const NodeId terms[] = {graph.multiply(m, graph.power(u, 2)), graph.multiply(graph.constant(3), graph.power(v, 2)),
                            graph.multiply(u, v)};
    const NodeId half = graph.divide(graph.sum(terms), graph.constant(2));
    const NodeId products[] = {half, graph.multiply(y[1], y[2]),
                               graph.multiply(graph.constant(5), graph.power(y[2], 2))};
    const NodeId lagrangian = graph.sum(products);
    const NodeId right[] = {graph.input("b1"), graph.input("b2"), graph.input("b3")};
    const auto hessian = read_hessian(graph, lagrangian, y);
    REQUIRE(hessian.has_value());
    const auto elimination = eliminate(graph, *hessian);
    REQUIRE(elimination.has_value());
    std::vector<NodeId> z = solve_by(graph, *elimination, right);
    // W z = b, with W from the derivatives
    const std::vector<NodeId> momenta = gradient(graph, lagrangian, y);
    std::vector<NodeId> residuals;
    for (std::size_t a = 0; a < 3; ++a) {
        std::vector<std::pair<NodeId, NodeId>> seeds;
        for (std::size_t b = 0; b < 3; ++b) seeds.emplace_back(y[b], z[b]);
        residuals.push_back(graph.subtract(directional(graph, std::vector{momenta[a]}, seeds)[0], right[a]));
    }
    residuals.insert(residuals.end(), z.begin(), z.end());
    const std::map<std::string, Rational> at{
        {"m", Rational(7, 3)}, {"c", Rational(-2, 5)}, {"y1", 0}, {"y2", 0}, {"y3", 0}, {"b1", 1}, {"b2", -4},
        {"b3", Rational(1, 9)}};
    const std::vector<Rational> values = evaluate_exactly(graph, residuals, at);
    REQUIRE(values.size() == 6);
    for (std::size_t a = 0; a < 3; ++a) {
        CHECK(values[a] == 0);
        CHECK(values[3 + a] != 0);
    }
}

namespace {

/// W z - b, with W from the derivatives of the quadratic function, for z from its elimination; then z.
std::vector<NodeId> residuals_and_solution(Graph& graph, NodeId lagrangian, const std::vector<NodeId>& y)
{
    std::vector<NodeId> right;
    for (std::size_t a = 0; a < y.size(); ++a) right.push_back(graph.input("b" + std::to_string(a + 1)));
    const auto hessian = read_hessian(graph, lagrangian, y);
    REQUIRE(hessian.has_value());
    const auto elimination = eliminate(graph, *hessian);
    REQUIRE(elimination.has_value());
    const std::vector<NodeId> z = solve_by(graph, *elimination, right);
    const std::vector<NodeId> momenta = gradient(graph, lagrangian, y);
    std::vector<std::pair<NodeId, NodeId>> seeds;
    for (std::size_t b = 0; b < y.size(); ++b) seeds.emplace_back(y[b], z[b]);
    std::vector<NodeId> result = directional(graph, momenta, seeds);
    for (std::size_t a = 0; a < y.size(); ++a) result[a] = graph.subtract(result[a], right[a]);
    result.insert(result.end(), z.begin(), z.end());
    return result;
}

/// The residuals vanish at rational points, the solution does not.
void check_solution(Graph& graph, NodeId lagrangian, const std::vector<NodeId>& y)
{
    const std::vector<NodeId> nodes = residuals_and_solution(graph, lagrangian, y);
    for (int seed = 1; seed <= 3; ++seed) {
        std::map<std::string, Rational> at;
        for (std::size_t k = 0; k < graph.inputs().size(); ++k) {
            const std::string& name = graph.input_name(graph.inputs()[k]);
            const int number = static_cast<int>(k);
            at[name] = 0;
            if (name[0] != 'y') at[name] = Rational(2 + (7 * number + 3 * seed) % 11) / Rational(1 + (5 * number) % 7);
        }
        const std::vector<Rational> values = evaluate_exactly(graph, nodes, at);
        for (std::size_t a = 0; a < y.size(); ++a) {
            INFO("seed " << seed << ", variable " << a);
            CHECK(values[a] == 0);
            CHECK(values[y.size() + a] != 0);
        }
    }
}

std::vector<NodeId> numbered(Graph& graph, const std::string& name, std::size_t count)
{
    std::vector<NodeId> nodes;
    for (std::size_t k = 0; k < count; ++k) nodes.push_back(graph.input(name + std::to_string(k + 1)));
    return nodes;
}

/// c u^2 for every term, and u v for the first two.
NodeId sum_of_products(Graph& graph, const std::vector<NodeId>& terms)
{
    NodeId sum = graph.multiply(terms[0], terms[1]);
    for (std::size_t k = 0; k < terms.size(); ++k) {
        const NodeId weight = graph.add(graph.input("m" + std::to_string(k + 1)), graph.constant(40));
        sum = graph.add(sum, graph.multiply(weight, graph.power(terms[k], 2)));
    }
    return sum;
}

} // namespace

TEST_CASE("variables that act through one term, two or three are eliminated exactly")
{
    Graph graph;
    const std::vector<NodeId> y = numbered(graph, "y", 5);
    const std::vector<NodeId> c = numbered(graph, "c", 9);
    const auto times = [&](std::size_t k, std::size_t a) { return graph.multiply(c[k], y[a]); };
    SECTION("a tree: two arms leave a square each at the same two terms")
    {
        const NodeId u = times(0, 0);
        const NodeId v = times(1, 0);
        std::vector<NodeId> terms{u, v};
        for (std::size_t arm = 1; arm < 5; ++arm) {
            terms.push_back(graph.add(u, times(2 * arm - 1, arm)));
            terms.push_back(graph.add(v, times(2 * arm, arm)));
        }
        check_solution(graph, sum_of_products(graph, terms), y);
    }
    SECTION("a chain, with a third term in the middle")
    {
        std::vector<NodeId> terms{times(0, 0), times(1, 0)};
        for (std::size_t a = 1; a < 5; ++a) {
            terms.push_back(graph.add(terms[terms.size() - (a == 3 ? 3 : 2)], times(a, a)));
            terms.push_back(graph.add(terms[terms.size() - 2], times(a + 4, a)));
            if (a == 2) terms.push_back(graph.add(terms.back(), times(3, 4)));
        }
        check_solution(graph, sum_of_products(graph, terms), y);
    }
    SECTION("two terms that touch each other, and more than two variables in what they leave")
    {
        const NodeId u = graph.add(graph.add(times(0, 0), times(1, 1)), times(2, 2));
        const NodeId v = graph.add(graph.add(times(3, 0), times(4, 1)), times(5, 3));
        std::vector<NodeId> terms{u, v};
        for (std::size_t a = 1; a < 5; ++a) terms.push_back(graph.subtract(times(a, a), y[a - 1]));
        check_solution(graph, sum_of_products(graph, terms), y);
    }
    SECTION("joint angles, one of them counted backwards and twice")
    {
        NodeId rate = y[0];
        NodeId u = times(0, 0);
        NodeId v = times(1, 0);
        std::vector<NodeId> terms{u, v};
        for (std::size_t a = 1; a < 5; ++a) {
            const NodeId joint = a == 2 ? graph.multiply(graph.constant(-2), y[a]) : y[a];
            rate = graph.add(rate, joint);
            terms.push_back(u = graph.add(u, graph.multiply(c[a], rate)));
            terms.push_back(v = graph.add(v, graph.multiply(c[a + 4], rate)));
        }
        check_solution(graph, sum_of_products(graph, terms), y);
    }
}

TEST_CASE("light masses above a heavy one do not cost the pivots of a chain their digits")
{
    // Each elimination as M - M e e^T M / d would leave the light mass as the difference of heavy ones.
    Graph graph;
    const Chain chain(graph, 6, Measured::absolute);
    const auto elimination = eliminate(graph, *read_hessian(graph, chain.lagrangian, chain.y));
    REQUIRE(elimination.has_value());
    std::vector<NodeId> pivots;
    for (const Elimination::Step& step : elimination->steps)
        if (!elimination->is_term[step.variable]) pivots.push_back(step.pivot);
    REQUIRE(pivots.size() == 6);
    for (unsigned seed = 1; seed <= 5; ++seed) {
        auto at = point<long double>(graph, seed);
        at["m6"] = 1e9L;
        std::map<std::string, double> rounded;
        for (auto& [name, value] : at) value = rounded[name] = static_cast<double>(value);
        const auto exact = evaluate<long double>(graph, pivots, at);
        const auto found = evaluate<double>(graph, pivots, rounded);
        for (std::size_t k = 0; k < pivots.size(); ++k) {
            INFO("seed " << seed << ", pivot " << k);
            CHECK(std::abs(static_cast<double>(exact[k]) - found[k]) < 1e-12 * std::abs(found[k]));
        }
    }
}

TEST_CASE("a chain in joint angles is solved at the cost of angles and their differences")
{
    std::vector<double> weights;
    for (const Measured angles : {Measured::absolute, Measured::relative}) {
        Graph graph;
        const Chain chain(graph, 16, angles);
        const auto elimination = eliminate(graph, *read_hessian(graph, chain.lagrangian, chain.y));
        REQUIRE(elimination.has_value());
        weights.push_back(weight(graph, solve_by(graph, *elimination, chain.right)));
    }
    CHECK(weights[1] < weights[0] + 4 * 16); // the sums of angles, two differences a joint
}

TEST_CASE("a chain solved through its terms keeps the digits of the dense factorisation")
{
    for (const Measured angles : {Measured::absolute, Measured::relative})
        for (const std::size_t n : {std::size_t{2}, std::size_t{5}, std::size_t{16}}) {
            Graph graph;
            const Chain chain(graph, n, angles);
            const auto elimination = eliminate(graph, *read_hessian(graph, chain.lagrangian, chain.y));
            REQUIRE(elimination.has_value());
            const std::vector<NodeId> sparse = solve_by(graph, *elimination, chain.right);
            double worst_sparse = 0;
            double worst_dense = 0;
            for (unsigned seed = 1; seed <= 10; ++seed) {
                worst_sparse = std::max(worst_sparse, error(graph, sparse, chain.dense, seed));
                worst_dense = std::max(worst_dense, error(graph, chain.dense, chain.dense, seed));
            }
            INFO("n = " << n << ", " << (angles == Measured::relative ? "relative" : "absolute") << ": " << worst_sparse
                        << ", dense " << worst_dense);
            CHECK(worst_sparse < 10 * std::max(worst_dense, 1e-15));
        }
}

TEST_CASE("the operations of a long chain grow linearly once its Hessian is remembered")
{
    for (const Measured angles : {Measured::absolute, Measured::relative}) {
        std::vector<double> weights;
        for (const std::size_t n : {std::size_t{16}, std::size_t{32}, std::size_t{64}}) {
            Graph graph;
            const Chain chain(graph, n, angles);
            graph.remember_hessian(chain.W, chain.y, chain.lagrangian);
            std::vector<NodeId> divisors;
            const std::vector<NodeId> simple = simplify(graph, chain.dense, divisors);
            CHECK(divisors.size() == n); // a pivot a variable
            CHECK(weight(graph, simple) < weight(graph, chain.dense) / 2);
            if (n == 16) CHECK(error(graph, simple, chain.dense, 3) < 1e-12);
            weights.push_back(weight(graph, simple));
        }
        CHECK(weights[1] < 2.1 * weights[0]);
        CHECK(weights[2] < 2.1 * weights[1]);
    }
}

TEST_CASE("without a remembered Hessian, and where the factorisation is lighter, systems stay nodes")
{
    const auto has_solve = [](const Graph& graph, const std::vector<NodeId>& nodes) {
        const auto below = reachable(graph, nodes);
        return std::ranges::any_of(below, [&](NodeId id) { return graph.op(id) == Op::solve; });
    };
    Graph unknown;
    const Chain chain(unknown, 16, Measured::absolute);
    CHECK(has_solve(unknown, simplify(unknown, chain.dense)));
    Graph small;
    const Chain pair(small, 2, Measured::absolute);
    small.remember_hessian(pair.W, pair.y, pair.lagrangian);
    CHECK(has_solve(small, simplify(small, pair.dense)));
}

TEST_CASE("derivatives of a solution are solved through the same terms")
{
    Graph graph;
    const Chain chain(graph, 12, Measured::absolute);
    graph.remember_hessian(chain.W, chain.y, chain.lagrangian);
    const std::pair<NodeId, NodeId> seed[] = {{graph.input("a3"), graph.constant(1)}};
    const std::vector<NodeId> tangent = directional(graph, chain.dense, seed);
    const std::vector<NodeId> simple = simplify(graph, tangent);
    CHECK(count_operations(graph, tangent).solves == 2);
    CHECK(count_operations(graph, simple).solves == 0);
    CHECK(error(graph, simple, tangent, 5) < 1e-12);
}
