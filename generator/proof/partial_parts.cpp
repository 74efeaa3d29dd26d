// SPDX-License-Identifier: GPL-2.0-or-later
/// The walk over the tree.
#include "proof/partial_parts.hpp"

#include "graph/core/operators.hpp"

#include <set>

namespace lagen {

namespace {

bool is_partial(const TreeNode& tree)
{
    if (tree.kind == TreeKind::divide || tree.kind == TreeKind::solve) return true;
    if (tree.kind == TreeKind::power) {
        const TreeNode& exponent = *tree.arguments[1];
        return exponent.kind != TreeKind::number || exponent.number < 0 || exponent.number.get_den() != 1;
    }
    return tree.kind == TreeKind::call && operator_of(op_of(tree.function)).domain != nullptr;
}

} // namespace

std::vector<NodeId> partial_parts(Graph& graph, Lowering& lower, const Tree& tree)
{
    std::set<NodeId> parts;
    std::set<const TreeNode*> seen;
    std::vector<Tree> open{tree};
    while (!open.empty()) {
        const Tree top = open.back();
        open.pop_back();
        if (top == nullptr || !seen.insert(top.get()).second) continue;
        if (is_partial(*top)) {
            const NodeId node = lower(top);
            const bool division = top->kind == TreeKind::divide;
            if (!graph.is_constant(node) && (!division || graph.op(node) == Op::divide)) {
                parts.insert(node);
            } else if (division) {
                const NodeId divisor = lower(top->arguments[1]);
                if (!graph.is_constant(divisor)) parts.insert(graph.divide(graph.constant(1), divisor));
            }
        }
        const bool branches = top->kind == TreeKind::call && top->function == Function::select;
        const std::size_t count = branches ? 1 : top->arguments.size();
        for (std::size_t k = count; k-- > 0;) open.push_back(top->arguments[k]);
    }
    return {parts.begin(), parts.end()};
}

} // namespace lagen
