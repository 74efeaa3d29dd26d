// SPDX-License-Identifier: GPL-2.0-or-later
/// What rounding does to equations as they are written, to first order [Higham 2002, chapter 3].
#include "graph/implicit.hpp"

#include <map>

namespace lagen {

namespace {

/// A bound of |df/da| for f of one operand a.
NodeId slope_bound(Graph& graph, Op op, NodeId f, NodeId a)
{
    const NodeId one = graph.constant(1);
    switch (op) {
    case Op::sqrt: return graph.divide(graph.constant(Rational(1, 2)), f);
    case Op::log: return graph.divide(one, graph.apply(Op::abs, a));
    case Op::exp:
    case Op::cosh: return f;
    case Op::sinh: return graph.add(graph.apply(Op::abs, f), one);
    case Op::tan: return graph.add(graph.power(f, 2), one);
    case Op::asin:
    case Op::acos: return graph.divide(one, graph.apply(Op::sqrt, graph.subtract(one, graph.power(a, 2))));
    default: return one; // sin, cos, atan, tanh, abs and what has no slope
    }
}

/// The rounding error of one operation in units of epsilon, from those of its operands.
NodeId rounding_of(Graph& graph, NodeId node, const std::map<NodeId, NodeId>& sizes)
{
    const std::vector<NodeId> operands(graph.operands(node).begin(), graph.operands(node).end());
    const NodeId zero = graph.constant(0);
    if (operands.empty()) return zero;
    const auto size = [&](std::size_t k) { return sizes.at(operands[k]); };
    const auto absolute = [&](NodeId value) { return graph.apply(Op::abs, value); };
    const auto carried = [&](std::size_t k, NodeId slope) {
        return graph.is_zero(size(k)) ? zero : graph.multiply(size(k), slope);
    };
    NodeId inherited = zero;
    switch (graph.op(node)) {
    case Op::negate: return size(0);
    case Op::select: return graph.select(operands[0], size(1), size(2));
    case Op::multiply:
        inherited = graph.add(carried(0, absolute(operands[1])), carried(1, absolute(operands[0])));
        break;
    case Op::divide:
        inherited = graph.add(size(0), carried(1, absolute(node)));
        if (!graph.is_zero(inherited)) inherited = graph.divide(inherited, absolute(operands[1]));
        break;
    case Op::power: {
        const auto exponent = static_cast<std::int32_t>(graph.payload(node));
        inherited =
            carried(0, absolute(graph.multiply(graph.constant(exponent), graph.power(operands[0], exponent - 1))));
        break;
    }
    case Op::real_power:
        inherited = carried(0, absolute(graph.divide(graph.multiply(operands[1], node), operands[0])));
        break;
    default:
        if (operands.size() == 1) {
            inherited = carried(0, slope_bound(graph, graph.op(node), node, operands[0]));
            break;
        }
        for (std::size_t k = 0; k < operands.size(); ++k) inherited = graph.add(inherited, size(k));
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
