// SPDX-License-Identifier: GPL-2.0-or-later
/// Nodes back to trees; a shared node becomes one shared tree.
#include "graph/core/lower.hpp"
#include "graph/core/operators.hpp"

namespace lagen {
namespace {

Tree pi_tree()
{
    auto node = std::make_shared<TreeNode>();
    node->kind = TreeKind::pi;
    return node;
}

Tree leaf_tree(const Graph& graph, NodeId id)
{
    if (graph.is_constant(id)) return number(graph.value(id));
    return graph.op(id) == Op::pi ? pi_tree() : name(graph.input_name(id));
}

/// The tree of one node from those of its operands.
Tree combine(const Graph& graph, NodeId id, std::vector<Tree> operands)
{
    const Op op = graph.op(id);
    const Operator& row = operator_of(op);
    switch (row.kind) {
    case OpKind::leaf: return leaf_tree(graph, id);
    case OpKind::sum:
        if (op == Op::negate) return negate(operands[0]);
        return op == Op::add ? add(std::move(operands)) : add({operands[0], negate(operands[1])});
    case OpKind::product: return multiply(std::move(operands));
    case OpKind::quotient: return divide(operands[0], operands[1]);
    case OpKind::power: return power(operands[0], number(Rational(static_cast<std::int32_t>(graph.payload(id)))));
    case OpKind::comparison: return compare(*row.comparison, operands[0], operands[1]);
    case OpKind::function:
    case OpKind::choice:
        if (op == Op::real_power) return power(operands[0], operands[1]);
        if (op == Op::stumpff) operands.insert(operands.begin(), number(Rational(graph.payload(id))));
        return call(*row.function, std::move(operands));
    case OpKind::system: break;
    }
    throw InternalError(std::string("no tree is written for ") + row.name);
}

/// z_k of A z = b from the trees of the entries of A and b.
Tree component_tree(const Graph& graph, NodeId id, const std::vector<Tree>& trees)
{
    const auto operands = graph.operands(graph.operands(id)[0]);
    std::vector<Tree> matrix;
    std::vector<Tree> right;
    for (const NodeId entry : graph.operands(operands[0])) matrix.push_back(trees[entry]);
    for (const NodeId entry : operands.subspan(1)) right.push_back(trees[entry]);
    return solve_component(std::move(matrix), right, graph.payload(id));
}

} // namespace

Tree to_tree(const Graph& graph, NodeId id)
{
    const NodeId roots[] = {id};
    return to_trees(graph, roots, [](NodeId, Tree tree) { return tree; })[0];
}

std::vector<Tree> to_trees(const Graph& graph, std::span<const NodeId> roots,
                           const std::function<Tree(NodeId, Tree)>& put)
{
    std::vector<Tree> trees(graph.size());
    for (const NodeId node : reachable(graph, roots)) {
        const Op op = graph.op(node);
        if (op == Op::factor || op == Op::solve) continue; // their components read the entries themselves
        if (op == Op::component) {
            trees[node] = put(node, component_tree(graph, node, trees));
            continue;
        }
        std::vector<Tree> operands;
        for (const NodeId operand : graph.operands(node)) operands.push_back(trees[operand]);
        trees[node] = put(node, combine(graph, node, std::move(operands)));
    }
    std::vector<Tree> result;
    for (const NodeId root : roots) result.push_back(trees[root]);
    return result;
}

} // namespace lagen
