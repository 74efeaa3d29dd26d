// SPDX-License-Identifier: GPL-2.0-or-later
/// What the definedness of roots and logarithms says about the signs of their operands.
#include "proof/normal_form.hpp"

namespace lagen::proof {

namespace {

bool is_simple(const Graph& graph, NodeId operand)
{
    for (const NodeId node : reachable(graph, std::vector<NodeId>{operand})) {
        const Op op = graph.op(node);
        if (op > Op::power && op != Op::sin && op != Op::cos) return false;
    }
    return true;
}

} // namespace

std::vector<NonnegativeOperand> nonnegative_operands(const Graph& graph, const std::vector<NodeId>& roots)
{
    std::vector<NonnegativeOperand> found;
    const std::vector<NodeId> needed = certainly_needed(graph, roots);
    for (std::size_t k = needed.size(); k-- > 0;) {
        const NodeId node = needed[k];
        const auto operands = graph.operands(node);
        const Op op = graph.op(node);
        if (op != Op::log && op != Op::sqrt && op != Op::real_power) continue;
        bool positive = op == Op::log;
        if (op == Op::real_power) {
            // x^n with a parameter n is defined for negative x too where n is an integer.
            if (!graph.is_constant(operands[1]) || graph.value(operands[1]).get_den() == 1) continue;
            positive = sgn(graph.value(operands[1])) < 0;
        }
        if (is_simple(graph, operands[0])) found.push_back({operands[0], positive});
    }
    return found;
}

} // namespace lagen::proof
