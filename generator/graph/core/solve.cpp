// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear systems as nodes: split into blocks that do not touch, one factorisation a block.
#include "expression/linear_algebra.hpp"
#include "graph/core/graph.hpp"

#include <algorithm>
#include <numeric>

namespace lagen {
namespace {

/// One block with everything where some part is not square (the matrix is singular by structure).
std::vector<CoupledBlock> square_blocks(const Graph& graph, std::span<const NodeId> matrix, std::size_t n)
{
    std::vector<CoupledBlock> blocks =
        coupled_blocks(n, [&](std::size_t i, std::size_t j) { return graph.is_zero(matrix[i * n + j]); });
    if (std::ranges::all_of(blocks, [](const CoupledBlock& b) { return b.rows.size() == b.columns.size(); }))
        return blocks;
    CoupledBlock whole;
    whole.rows.resize(n);
    std::iota(whole.rows.begin(), whole.rows.end(), std::size_t{0});
    whole.columns = whole.rows;
    return {whole};
}

} // namespace

std::vector<std::vector<NodeId>>
Graph::solve(std::span<const NodeId> matrix, const std::vector<std::vector<NodeId>>& columns, MatrixStructure structure)
{
    const std::size_t n = columns.empty() ? 0 : columns.front().size();
    for (const auto& column : columns)
        if (column.size() != n || matrix.size() != n * n)
            throw InternalError("solve() wants n*n entries of the matrix and n of every right-hand side");
    std::vector<std::vector<NodeId>> result(columns.size(), std::vector<NodeId>(n, constant(0)));
    const std::vector<NodeId> entries(matrix.begin(), matrix.end());
    for (const CoupledBlock& block : square_blocks(*this, entries, n)) {
        const std::size_t size = block.rows.size();
        if (size == 1) {
            const NodeId divisor = entries[block.rows[0] * n + block.columns[0]];
            for (std::size_t k = 0; k < columns.size(); ++k)
                result[k][block.columns[0]] = divide(columns[k][block.rows[0]], divisor);
            continue;
        }
        std::vector<NodeId> part;
        for (const std::size_t i : block.rows)
            for (const std::size_t j : block.columns) part.push_back(entries[i * n + j]);
        const auto kept = block.rows == block.columns ? structure : MatrixStructure::general;
        const NodeId factor = intern(Op::factor, part, static_cast<std::uint32_t>(kept));
        for (std::size_t k = 0; k < columns.size(); ++k) {
            std::vector<NodeId> operands{factor};
            for (const std::size_t i : block.rows) operands.push_back(columns[k][i]);
            if (std::all_of(operands.begin() + 1, operands.end(), [&](NodeId b) { return is_zero(b); })) continue;
            const NodeId solution[] = {intern(Op::solve, operands, 0)};
            for (std::size_t j = 0; j < size; ++j)
                result[k][block.columns[j]] = intern(Op::component, solution, static_cast<std::uint32_t>(j));
        }
    }
    return result;
}

void Graph::remember_hessian(std::span<const NodeId> matrix, std::span<const NodeId> variables, NodeId value)
{
    const std::size_t n = variables.size();
    if (matrix.size() != n * n) throw InternalError("remember_hessian() wants n*n entries for n variables");
    const std::vector<NodeId> entries(matrix.begin(), matrix.end());
    for (const CoupledBlock& block : square_blocks(*this, entries, n)) {
        if (block.rows.size() < 2 || block.rows != block.columns) continue;
        std::vector<NodeId> part;
        HessianOrigin origin{value, {}};
        for (const std::size_t i : block.rows) {
            origin.variables.push_back(variables[i]);
            for (const std::size_t j : block.columns) part.push_back(entries[i * n + j]);
        }
        const auto structure = static_cast<std::uint32_t>(MatrixStructure::positive_definite);
        hessians_.insert_or_assign(intern(Op::factor, part, structure), std::move(origin));
    }
}

const HessianOrigin* Graph::hessian_origin(NodeId factor) const
{
    const auto found = hessians_.find(factor);
    return found == hessians_.end() ? nullptr : &found->second;
}

std::vector<NodeId> Graph::solve(std::span<const NodeId> matrix, std::span<const NodeId> right,
                                 MatrixStructure structure)
{
    const std::vector<NodeId> column(right.begin(), right.end());
    return solve(matrix, std::vector<std::vector<NodeId>>{column}, structure).front();
}

} // namespace lagen
