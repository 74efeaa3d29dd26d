// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear systems of graph nodes, a block of coupled rows and columns at a time.
#include "elaborate/build_workspace.hpp"

namespace lagen {

std::vector<CoupledBlock> coupled_blocks(const Graph& graph, const std::vector<NodeId>& matrix, std::size_t m)
{
    return coupled_blocks(m, [&](std::size_t i, std::size_t j) { return graph.is_zero(matrix[i * m + j]); });
}

namespace {

std::vector<NodeId> part_of(const std::vector<NodeId>& nodes, const Places& places)
{
    std::vector<NodeId> part;
    for (const std::size_t place : places) part.push_back(nodes[place]);
    return part;
}

/// Cramer's rule for one block; columns of `right` outside its rows do not enter.
void solve_written(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m, const CoupledBlock& block,
                   const std::vector<std::vector<NodeId>>& right, std::vector<std::vector<NodeId>>& result)
{
    for (std::size_t k = 0; k < right.size(); ++k) {
        const CramersRule z{graph, matrix, m, block.rows, block.columns, part_of(right[k], block.rows)};
        for (std::size_t j = 0; j < block.columns.size(); ++j) {
            const NodeId above = z.numerator(j);
            result[k][block.columns[j]] = graph.is_zero(above) ? above : graph.divide(above, z.divisor);
        }
    }
}

void solve_as_components(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m, const CoupledBlock& block,
                         const std::vector<std::vector<NodeId>>& right, std::vector<std::vector<NodeId>>& result)
{
    std::vector<NodeId> entries;
    for (const std::size_t row : block.rows)
        for (const std::size_t column : block.columns) entries.push_back(matrix[row * m + column]);
    for (std::size_t k = 0; k < right.size(); ++k) {
        const std::vector<NodeId> z = graph.solve(entries, part_of(right[k], block.rows), MatrixStructure::general);
        for (std::size_t j = 0; j < block.columns.size(); ++j) result[k][block.columns[j]] = z[j];
    }
}

} // namespace

std::vector<std::vector<NodeId>> solve_exactly(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m,
                                               const std::vector<std::vector<NodeId>>& right)
{
    std::vector<std::vector<NodeId>> result(right.size(), std::vector<NodeId>(m, graph.constant(0)));
    for (const CoupledBlock& block : coupled_blocks(graph, matrix, m)) {
        if (block.rows.size() != block.columns.size()) throw InternalError("a linear system is singular by structure");
        if (block.rows.size() <= written_determinant_limit)
            solve_written(graph, matrix, m, block, right, result);
        else
            solve_as_components(graph, matrix, m, block, right, result);
    }
    return result;
}

} // namespace lagen
