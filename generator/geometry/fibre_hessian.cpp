// SPDX-License-Identifier: GPL-2.0-or-later
/// Momenta, fibre Hessian, its coupled blocks and their minors.
#include "geometry/fibre_hessian.hpp"
#include "graph/differentiate.hpp"

#include <algorithm>
#include <bit>

namespace lagen {
namespace {

std::vector<std::vector<std::size_t>> coupled_blocks(const Graph& graph, const FibreHessian& hessian)
{
    const std::size_t r = hessian.momenta.size();
    std::vector<std::vector<std::size_t>> blocks;
    std::vector<bool> seen(r, false);
    for (std::size_t start = 0; start < r; ++start) {
        if (seen[start]) continue;
        std::vector<std::size_t> block = {start};
        seen[start] = true;
        for (std::size_t next = 0; next < block.size(); ++next)
            for (std::size_t b = 0; b < r; ++b)
                if (!seen[b] && !graph.is_zero(hessian.W(block[next], b))) {
                    seen[b] = true;
                    block.push_back(b);
                }
        std::sort(block.begin(), block.end());
        blocks.push_back(std::move(block));
    }
    return blocks;
}

} // namespace

FibreHessian fibre_hessian(Graph& graph, NodeId lagrangian, const std::vector<NodeId>& y)
{
    FibreHessian result;
    result.lagrangian = lagrangian;
    result.y = y;
    result.momenta = gradient(graph, lagrangian, y);
    for (const std::vector<NodeId>& row : jacobian(graph, result.momenta, y))
        result.hessian.insert(result.hessian.end(), row.begin(), row.end());
    // The two orders of differentiation may leave different nodes; one of them stands for both.
    const std::size_t r = y.size();
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const bool zero = graph.is_zero(result.W(a, b)) || graph.is_zero(result.W(b, a));
            const NodeId entry = zero ? graph.constant(0) : result.W(b, a);
            result.hessian[a * r + b] = entry;
            result.hessian[b * r + a] = entry;
        }
    result.blocks = coupled_blocks(graph, result);
    return result;
}

NodeId minor_determinant(Graph& graph, const FibreHessian& hessian, const std::vector<std::size_t>& rows,
                         const std::vector<std::size_t>& columns, std::optional<std::size_t> replaced,
                         const std::vector<NodeId>& right)
{
    const std::size_t m = columns.size();
    if (m > determinant_limit || rows.size() != m)
        throw InternalError("a minor of size " + std::to_string(m) + " was asked for");
    // minors[S]: the determinant of the first |S| rows and the columns in S, by expansion along its last row
    std::vector<NodeId> minors(std::size_t{1} << m, graph.constant(0));
    minors[0] = graph.constant(1);
    for (std::size_t set = 1; set < minors.size(); ++set) {
        const std::size_t row = static_cast<std::size_t>(std::popcount(set)) - 1;
        std::vector<NodeId> terms;
        std::size_t position = 0;
        for (std::size_t column = 0; column < m; ++column) {
            if (!(set >> column & 1U)) continue;
            const NodeId entry = replaced == column ? right[row] : hessian.W(rows[row], columns[column]);
            const NodeId term = graph.multiply(entry, minors[set & ~(std::size_t{1} << column)]);
            if (!graph.is_zero(term)) terms.push_back((row + position) % 2 == 0 ? term : graph.negate(term));
            ++position;
        }
        minors[set] = graph.sum(terms);
    }
    return minors.back();
}

} // namespace lagen
