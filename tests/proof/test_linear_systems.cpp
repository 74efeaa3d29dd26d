// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear systems of more than four unknowns in the zero decision.
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

/// A z = b of order n with entries from `entry(i, j)`, b_i the inputs b1, b2, ...
template <class Entry>
struct System {
    Problem problem;
    std::size_t n;
    std::vector<NodeId> matrix, right, z;

    System(std::size_t order, Entry entry) : problem({{}, {}, {}, {}, {}}), n(order)
    {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) matrix.push_back(problem.node(entry(i, j)));
            right.push_back(problem.node("b" + std::to_string(i + 1)));
        }
        z = problem.graph.solve(matrix, right, MatrixStructure::general);
    }

    /// Row i of A z - sign b.
    NodeId row(std::size_t i, long sign = 1)
    {
        Graph& g = problem.graph;
        NodeId sum = g.multiply(g.constant(-sign), right[i]);
        for (std::size_t j = 0; j < n; ++j) sum = g.add(sum, g.multiply(matrix[i * n + j], z[j]));
        return sum;
    }

    std::size_t rows_with(ProofStatus status, long sign = 1)
    {
        std::size_t count = 0;
        for (std::size_t i = 0; i < n; ++i) count += problem.decider->decide(row(i, sign)).status == status ? 1 : 0;
        return count;
    }
};

std::string symbol(const char* letter, std::size_t i, std::size_t j)
{
    return letter + std::to_string(i + 1) + "_" + std::to_string(j + 1);
}

std::string symmetric(std::size_t i, std::size_t j)
{
    return symbol("a", std::min(i, j), std::max(i, j));
}

} // namespace

TEST_CASE("the solution of a system satisfies its equations: numbers, bands, dense symbols beyond the minors")
{
    System numbers(20, [](std::size_t i, std::size_t j) { return std::to_string(i == j ? 7 : (3 * i + 5 * j) % 4); });
    CHECK(numbers.rows_with(ProofStatus::proved) == 20);
    System band(7, [](std::size_t i, std::size_t j) {
        return i == j ? symbol("a", i, j) : i + 1 == j || j + 1 == i ? std::string("cos(q)") : std::string("0");
    });
    CHECK(band.rows_with(ProofStatus::proved) == 7);
    System dense(12, [](std::size_t i, std::size_t j) { return symbol("a", i, j); });
    CHECK(dense.rows_with(ProofStatus::proved) == 12);
}

TEST_CASE("a wrong sign in the equations of a large system is refuted")
{
    System band(7, [](std::size_t i, std::size_t j) { return i == j ? "2" : i + 1 == j || j + 1 == i ? "x" : "0"; });
    CHECK(band.rows_with(ProofStatus::refuted, -1) == 7);
    System dense(9, [](std::size_t i, std::size_t j) { return symbol("a", i, j); });
    CHECK(dense.rows_with(ProofStatus::refuted, -1) == 9);
}

TEST_CASE("z b = z A z holds for a symmetric matrix of any order")
{
    for (const std::size_t n : {5U, 10U}) {
        System system(n, symmetric);
        Graph& g = system.problem.graph;
        NodeId sum = g.constant(0);
        for (std::size_t i = 0; i < n; ++i) sum = g.add(sum, g.multiply(system.z[i], system.row(i)));
        CHECK(system.problem.decider->decide(sum).status == ProofStatus::proved);
    }
}

TEST_CASE("two solutions of one large matrix are linear in the right-hand side")
{
    // Beyond the minors this needs A^-1 (b + c) = A^-1 b + A^-1 c, which no combination of rows shows.
    System system(6, [](std::size_t i, std::size_t j) { return i == j ? symbol("a", i, j) : i < j ? "x" : "y"; });
    Graph& g = system.problem.graph;
    std::vector<NodeId> twice;
    for (const NodeId b : system.right) twice.push_back(g.multiply(g.constant(2), b));
    const auto z = g.solve(system.matrix, twice, MatrixStructure::general);
    const NodeId difference = g.subtract(z[3], g.multiply(g.constant(2), system.z[3]));
    CHECK(system.problem.decider->decide(difference).status == ProofStatus::proved);
}
