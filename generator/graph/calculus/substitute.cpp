// SPDX-License-Identifier: GPL-2.0-or-later
/// Substitution: the reachable nodes again, on other operands.
#include "graph/calculus/substitute.hpp"

#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {

NodeId Rebuilder::rebuild_scalar(NodeId old) const
{
    const auto operands = graph_.operands(old);
    if (operands.empty()) return old;
    NodeId mapped[3]{};
    for (std::size_t k = 0; k < operands.size(); ++k) mapped[k] = map_[operands[k]];
    return graph_.make(graph_.op(old), graph_.payload(old), {mapped, operands.size()});
}

void Rebuilder::rebuild_solve(NodeId solve)
{
    const auto operands = graph_.operands(solve);
    const NodeId factor = operands[0];
    std::vector<NodeId> matrix;
    std::vector<NodeId> right;
    for (const NodeId entry : graph_.operands(factor)) matrix.push_back(map_[entry]);
    for (const NodeId entry : operands.subspan(1)) right.push_back(map_[entry]);
    solutions_.emplace_back(solve, graph_.solve(matrix, right, static_cast<MatrixStructure>(graph_.payload(factor))));
}

void Rebuilder::rebuild(NodeId old)
{
    const Op op = graph_.op(old);
    if (op == Op::factor) return;
    if (op == Op::solve) return rebuild_solve(old);
    if (op != Op::component) {
        map_[old] = rebuild_scalar(old);
        return;
    }
    const NodeId solve = graph_.operands(old)[0];
    const auto found = std::ranges::lower_bound(solutions_, solve, {}, [](const auto& entry) { return entry.first; });
    map_[old] = found->second[graph_.payload(old)];
}

std::vector<NodeId> substitute(Graph& graph, std::span<const NodeId> outputs,
                               std::span<const std::pair<NodeId, NodeId>> replacements)
{
    const auto nodes = reachable(graph, outputs);
    Rebuilder map(graph, nodes.empty() ? 0 : std::size_t{nodes.back()} + 1);
    std::vector<bool> replaced(nodes.empty() ? 0 : std::size_t{nodes.back()} + 1, false);
    for (const auto& [from, to] : replacements)
        if (from < replaced.size()) {
            map.set(from, to);
            replaced[from] = true;
        }
    for (const NodeId id : nodes)
        if (!replaced[id]) map.rebuild(id);
    std::vector<NodeId> result;
    for (const NodeId output : outputs) result.push_back(map[output]);
    return result;
}

std::optional<std::vector<NodeId>> substitute_where_defined(Graph& graph, std::span<const NodeId> outputs,
                                                            std::span<const std::pair<NodeId, NodeId>> replacements)
{
    try {
        return substitute(graph, outputs, replacements);
    } catch (const DivisionByZero&) {
        return std::nullopt;
    }
}

} // namespace lagen
