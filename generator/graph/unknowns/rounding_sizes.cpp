// SPDX-License-Identifier: GPL-2.0-or-later
/// What rounding does to equations as they are written, to first order [Higham 2002, chapter 3].
#include "graph/core/operators.hpp"
#include "graph/unknowns/implicit.hpp"

#include <map>

namespace lagen {

namespace {

/// The rounding error of one operation in units of epsilon, from those of its operands.
NodeId rounding_of(Graph& graph, NodeId node, const std::map<NodeId, NodeId>& sizes)
{
    const std::vector<NodeId> operands(graph.operands(node).begin(), graph.operands(node).end());
    const NodeId zero = graph.constant(0);
    if (operands.empty()) return zero;
    const auto size = [&](std::size_t k) { return sizes.at(operands[k]); };
    const auto absolute = [&](NodeId value) { return graph.apply(Op::abs, value); };
    NodeId inherited = zero;
    const Op op = graph.op(node);
    switch (kind_of(op)) {
    case OpKind::leaf: return zero;
    case OpKind::choice: return graph.select(operands[0], size(1), size(2));
    case OpKind::sum:
        if (operands.size() == 1) return size(0);
        inherited = graph.add(size(0), size(1));
        break;
    case OpKind::quotient:
        inherited = size(0);
        if (!graph.is_zero(size(1))) inherited = graph.add(inherited, graph.multiply(size(1), absolute(node)));
        if (!graph.is_zero(inherited)) inherited = graph.divide(inherited, absolute(operands[1]));
        break;
    case OpKind::system: // the sum of all sizes; factor and solve have no value of their own
        for (std::size_t k = 0; k < operands.size(); ++k) inherited = graph.add(inherited, size(k));
        if (op != Op::component) return inherited;
        break;
    case OpKind::product:
    case OpKind::power:
    case OpKind::function:
    case OpKind::comparison:
        for (std::size_t k = 0; k < operands.size(); ++k)
            if (!graph.is_zero(size(k)))
                inherited = graph.add(inherited, graph.multiply(size(k), slope_bound(graph, node, k)));
    }
    return graph.add(inherited, absolute(node));
}

} // namespace

std::vector<NodeId> rounding_sizes(Graph& graph, std::span<const NodeId> residuals)
{
    std::map<NodeId, NodeId> sizes;
    for (const NodeId node : reachable(graph, residuals)) sizes[node] = rounding_of(graph, node, sizes);
    std::vector<NodeId> result;
    for (const NodeId residual : residuals) result.push_back(sizes.at(residual));
    return result;
}

} // namespace lagen
