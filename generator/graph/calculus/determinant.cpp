// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/calculus/determinant.hpp"

#include "expression/linear_algebra.hpp"

namespace lagen {

namespace {

/// The chosen rows and columns of a matrix of nodes.
struct NodeRing {
    using Number = NodeId;
    Graph& graph;
    const std::vector<NodeId>& matrix;
    std::size_t width;
    const Places& rows;
    const Places& columns;

    [[nodiscard]] NodeId zero() const { return graph.constant(0); }
    [[nodiscard]] NodeId one() const { return graph.constant(1); }
    [[nodiscard]] NodeId entry(std::size_t i, std::size_t j) const { return matrix[rows[i] * width + columns[j]]; }
    [[nodiscard]] bool is_zero(NodeId a) const { return graph.is_zero(a); }
    [[nodiscard]] NodeId times(NodeId a, NodeId b) const { return graph.multiply(a, b); }
    void add(NodeId& sum, NodeId term, int sign) const { sum = graph.add(sum, sign > 0 ? term : graph.negate(term)); }
};

} // namespace

NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t width, const Places& rows,
                      const Places& columns)
{
    const std::size_t m = columns.size();
    if (m > determinant_limit || rows.size() != m)
        throw InternalError("a determinant of size " + std::to_string(m) + " was asked for");
    return determinant(NodeRing{graph, matrix, width, rows, columns}, m, ExpandBy::last_row);
}

NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t size)
{
    return determinant_of(graph, matrix, size, first_places(size), first_places(size));
}

NodeId CramersRule::numerator(std::size_t k) const
{
    return lagen::numerator(NodeRing{graph, matrix, width, rows, columns}, k, b, ExpandBy::last_row);
}

std::vector<NodeId> CramersRule::solution() const
{
    std::vector<NodeId> z;
    for (std::size_t k = 0; k < columns.size(); ++k) z.push_back((*this)(k));
    return z;
}

} // namespace lagen
