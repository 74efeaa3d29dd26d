// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/determinant.hpp"

#include <bit>

namespace lagen {

NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t width,
                      const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns)
{
    const std::size_t m = columns.size();
    if (m > determinant_limit || rows.size() != m)
        throw InternalError("a determinant of size " + std::to_string(m) + " was asked for");
    // minors[S]: the determinant of the first |S| rows and the columns in S, by expansion along its last row
    std::vector<NodeId> minors(std::size_t{1} << m, graph.constant(0));
    minors[0] = graph.constant(1);
    for (std::size_t set = 1; set < minors.size(); ++set) {
        const std::size_t row = static_cast<std::size_t>(std::popcount(set)) - 1;
        std::vector<NodeId> terms;
        std::size_t position = 0;
        for (std::size_t column = 0; column < m; ++column) {
            if (!(set >> column & 1U)) continue;
            const NodeId entry = matrix[rows[row] * width + columns[column]];
            const NodeId term = graph.multiply(entry, minors[set & ~(std::size_t{1} << column)]);
            if (!graph.is_zero(term)) terms.push_back((row + position) % 2 == 0 ? term : graph.negate(term));
            ++position;
        }
        minors[set] = graph.sum(terms);
    }
    return minors.back();
}

} // namespace lagen
