// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/smoothness.hpp"

namespace lagen {

SmoothWhere smooth_where(Graph& graph, NodeId node)
{
    using enum SmoothWhere::Condition;
    const std::vector<NodeId> operands(graph.operands(node).begin(), graph.operands(node).end());
    if (compares(graph.op(node))) return {nonzero, graph.subtract(operands[0], operands[1])};
    switch (graph.op(node)) {
    case Op::divide: return {nonzero, operands[1]};
    case Op::power:
        if (static_cast<std::int32_t>(graph.payload(node)) > 0) return {};
        return {nonzero, operands[0]};
    case Op::abs:
    case Op::sign: return {nonzero, operands[0]};
    case Op::tan: return {nonzero, graph.apply(Op::cos, operands[0])};
    case Op::sqrt:
    case Op::log:
    case Op::real_power: return {positive, operands[0]};
    case Op::asin:
    case Op::acos: return {positive, graph.subtract(graph.constant(1), graph.power(operands[0], 2))};
    default: return {};
    }
}

bool compares(Op op)
{
    switch (op) {
    case Op::minimum:
    case Op::maximum:
    case Op::less:
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
    case Op::equal:
    case Op::not_equal: return true;
    default: return false;
    }
}

bool has_kink(Op op)
{
    return op == Op::abs || op == Op::sign || compares(op);
}

bool is_meromorphic(Op op)
{
    switch (op) {
    case Op::constant:
    case Op::pi:
    case Op::input:
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::negate:
    case Op::power:
    case Op::sin:
    case Op::cos:
    case Op::tan:
    case Op::sinh:
    case Op::cosh:
    case Op::tanh:
    case Op::exp:
    case Op::stumpff: return true;
    default: return false;
    }
}

} // namespace lagen
