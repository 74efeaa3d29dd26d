// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/calculus/determinant.hpp"

#include "expression/linear_algebra.hpp"

#include <numeric>

namespace lagen {

namespace {

/// The chosen rows and columns of a matrix of nodes.
struct NodeRing {
    using Number = NodeId;
    Graph& graph;
    const std::vector<NodeId>& matrix;
    std::size_t width;
    const std::vector<std::size_t>& rows;
    const std::vector<std::size_t>& columns;

    [[nodiscard]] NodeId zero() const { return graph.constant(0); }
    [[nodiscard]] NodeId one() const { return graph.constant(1); }
    [[nodiscard]] NodeId entry(std::size_t i, std::size_t j) const { return matrix[rows[i] * width + columns[j]]; }
    [[nodiscard]] bool is_zero(NodeId a) const { return graph.is_zero(a); }
    [[nodiscard]] NodeId times(NodeId a, NodeId b) const { return graph.multiply(a, b); }
    void add(NodeId& sum, NodeId term, int sign) const { sum = graph.add(sum, sign > 0 ? term : graph.negate(term)); }
};

} // namespace

NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t width,
                      const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns)
{
    const std::size_t m = columns.size();
    if (m > determinant_limit || rows.size() != m)
        throw InternalError("a determinant of size " + std::to_string(m) + " was asked for");
    return determinant(NodeRing{graph, matrix, width, rows, columns}, m, ExpandBy::last_row);
}

NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t size)
{
    std::vector<std::size_t> all(size);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return determinant_of(graph, matrix, size, all, all);
}

std::vector<NodeId> solved_by_cramer(Graph& graph, const std::vector<NodeId>& A, NodeId divisor,
                                     const std::vector<NodeId>& b)
{
    const std::size_t size = b.size();
    std::vector<NodeId> out;
    for (std::size_t column = 0; column < size; ++column) {
        std::vector<NodeId> replaced = A;
        for (std::size_t row = 0; row < size; ++row) replaced[row * size + column] = b[row];
        out.push_back(graph.divide(determinant_of(graph, replaced, size), divisor));
    }
    return out;
}

} // namespace lagen
