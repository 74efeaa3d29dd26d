// SPDX-License-Identifier: GPL-2.0-or-later
/// Nodes back to trees; a shared node becomes one shared tree.
#include "graph/lower.hpp"
#include "graph/operators.hpp"

namespace lagen {
namespace {

Tree pi_tree()
{
    auto node = std::make_shared<TreeNode>();
    node->kind = TreeKind::pi;
    return node;
}

Comparison comparison_of(Op op)
{
    switch (op) {
    case Op::less: return Comparison::less;
    case Op::less_equal: return Comparison::less_equal;
    case Op::greater: return Comparison::greater;
    case Op::greater_equal: return Comparison::greater_equal;
    case Op::equal: return Comparison::equal;
    default: return Comparison::not_equal;
    }
}

/// The tree of one node from those of its operands.
Tree combine(const Graph& graph, NodeId id, std::vector<Tree> operands)
{
    const Op op = graph.op(id);
    switch (op) {
    case Op::constant: return number(graph.value(id));
    case Op::pi: return pi_tree();
    case Op::input: return name(graph.input_name(id));
    case Op::add: return add(std::move(operands));
    case Op::subtract: return add({operands[0], negate(operands[1])});
    case Op::multiply: return multiply(std::move(operands));
    case Op::divide: return divide(operands[0], operands[1]);
    case Op::negate: return negate(operands[0]);
    case Op::power: return power(operands[0], number(Rational(static_cast<std::int32_t>(graph.payload(id)))));
    case Op::real_power: return power(operands[0], operands[1]);
    case Op::stumpff: return call(Function::stumpff, {number(Rational(graph.payload(id))), operands[0]});
    default: break;
    }
    if (op >= Op::less && op <= Op::not_equal) return compare(comparison_of(op), operands[0], operands[1]);
    const FunctionEntry* entry = find_function(operator_of(op).name);
    if (entry == nullptr) throw InternalError(std::string("no built-in function is called ") + operator_of(op).name);
    return call(entry->function, std::move(operands));
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
    std::vector<Tree> trees(std::size_t{id} + 1);
    for (const NodeId node : reachable(graph, roots)) {
        const Op op = graph.op(node);
        if (op == Op::factor || op == Op::solve) continue; // their components read the entries themselves
        if (op == Op::component) {
            trees[node] = component_tree(graph, node, trees);
            continue;
        }
        std::vector<Tree> operands;
        for (const NodeId operand : graph.operands(node)) operands.push_back(trees[operand]);
        trees[node] = combine(graph, node, std::move(operands));
    }
    return trees[id];
}

} // namespace lagen
