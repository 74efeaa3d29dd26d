// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear systems of graph nodes, a block of coupled rows and columns at a time.
#include "elaborate/build_workspace.hpp"

namespace lagen {

std::vector<CoupledBlock> coupled_blocks(const Graph& graph, const std::vector<NodeId>& matrix, std::size_t m)
{
    return coupled_blocks(m, [&](std::size_t i, std::size_t j) { return graph.is_zero(matrix[i * m + j]); });
}

namespace {

/// Cramer's rule for one block; columns of `right` outside its rows do not enter.
void solve_written(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m, const CoupledBlock& block,
                   const std::vector<std::vector<NodeId>>& right, std::vector<std::vector<NodeId>>& result)
{
    const NodeId determinant = determinant_of(graph, matrix, m, block.rows, block.columns);
    for (std::size_t k = 0; k < right.size(); ++k)
        for (const std::size_t column : block.columns) {
            std::vector<NodeId> replaced = matrix;
            for (const std::size_t row : block.rows) replaced[row * m + column] = right[k][row];
            const NodeId above = determinant_of(graph, replaced, m, block.rows, block.columns);
            result[k][column] = graph.is_zero(above) ? above : graph.divide(above, determinant);
        }
}

void solve_as_components(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m, const CoupledBlock& block,
                         const std::vector<std::vector<NodeId>>& right, std::vector<std::vector<NodeId>>& result)
{
    std::vector<NodeId> entries;
    for (const std::size_t row : block.rows)
        for (const std::size_t column : block.columns) entries.push_back(matrix[row * m + column]);
    for (std::size_t k = 0; k < right.size(); ++k) {
        std::vector<NodeId> b;
        for (const std::size_t row : block.rows) b.push_back(right[k][row]);
        const std::vector<NodeId> z = graph.solve(entries, b, MatrixStructure::general);
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
