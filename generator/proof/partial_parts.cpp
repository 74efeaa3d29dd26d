// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/partial_parts.hpp"

#include "expression/find_part.hpp"
#include "graph/core/operators.hpp"

#include <set>
#include <span>

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

/// The arguments that are evaluated wherever the tree is: of if(..) the condition alone.
std::span<const Tree> unconditional(const Tree& tree)
{
    const bool branches = tree->kind == TreeKind::call && tree->function == Function::select;
    return std::span(tree->arguments).first(branches ? 1 : tree->arguments.size());
}

} // namespace

std::vector<NodeId> partial_parts(Graph& graph, Lowering& lower, const Tree& tree)
{
    std::set<NodeId> parts;
    const auto take = [&](const Tree& part) {
        if (!is_partial(*part)) return false;
        const NodeId node = lower(part);
        const bool division = part->kind == TreeKind::divide;
        if (!graph.is_constant(node) && (!division || graph.op(node) == Op::divide)) {
            parts.insert(node);
        } else if (division) {
            const NodeId divisor = lower(part->arguments[1]);
            if (!graph.is_constant(divisor)) parts.insert(graph.divide(graph.constant(1), divisor));
        }
        return false;
    };
    (void)PartSearch()(tree, take, unconditional);
    return {parts.begin(), parts.end()};
}

} // namespace lagen
