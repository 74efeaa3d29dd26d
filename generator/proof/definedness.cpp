// SPDX-License-Identifier: GPL-2.0-or-later
/// What the definedness of roots and logarithms says about the signs of their operands.
#include "graph/core/operators.hpp"
#include "proof/normal_form.hpp"

namespace lagen::proof {

namespace {

bool is_simple(const Graph& graph, NodeId operand)
{
    for (const NodeId node : reachable(graph, std::vector<NodeId>{operand})) {
        const Op op = graph.op(node);
        if (!is_rational(op) && op != Op::sin && op != Op::cos) return false;
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
        const Sense sense = known_where_defined(graph, node);
        if (operator_of(graph.op(node)).condition_operand != 0) continue;
        if (sense != Sense::positive && sense != Sense::nonnegative) continue;
        const NodeId operand = graph.operands(node)[0];
        if (is_simple(graph, operand)) found.push_back({operand, sense == Sense::positive});
    }
    return found;
}

} // namespace lagen::proof
