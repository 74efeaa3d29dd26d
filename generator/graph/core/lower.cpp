// SPDX-License-Identifier: GPL-2.0-or-later
/// Lowering: closed trees to nodes, with an explicit stack.
#include "graph/core/lower.hpp"

#include "expression/evaluate_stumpff.hpp"
#include "graph/core/operators.hpp"

#include <utility>

namespace lagen {
namespace {

/// The text of a sub-expression as the user wrote it, cut for a message.
std::string quoted(const Tree& tree)
{
    constexpr std::size_t limit = 60;
    const SourceRange& where = tree->where;
    if (!where.file || where.end <= where.begin || where.end - where.begin > limit) return "";
    return " `" + where.file->text.substr(where.begin, where.end - where.begin) + "`";
}

NodeId lower_divide(Graph& graph, const TreeNode& tree, NodeId a, NodeId b)
{
    if (graph.is_zero(b))
        throw ModelError("division by zero: the divisor" + quoted(tree.arguments[1]) +
                             " is 0 everywhere, a divisor that is not identically zero is required",
                         tree.where, "check the divisor for terms that cancel");
    return graph.divide(a, b);
}

NodeId lower_power(Graph& graph, const TreeNode& tree, NodeId base, NodeId exponent)
{
    if (graph.is_zero(base) && graph.is_constant(exponent) && sgn(graph.value(exponent)) <= 0)
        throw ModelError("0^" + graph.value(exponent).get_str() + " has no value: the base" +
                             quoted(tree.arguments[0]) + " is 0 everywhere, a positive exponent is required",
                         tree.where, "check the base for terms that cancel");
    return graph.apply(Op::real_power, base, exponent);
}

/// stumpff(k, z), k a literal.
NodeId lower_stumpff(Graph& graph, const TreeNode& tree, std::span<const NodeId> arguments)
{
    const Rational* order = graph.is_constant(arguments[0]) ? &graph.value(arguments[0]) : nullptr;
    if (order == nullptr || order->get_den() != 1 || *order < 0 || *order > largest_stumpff_order)
        throw ModelError("the first argument of stumpff is" +
                             (order != nullptr ? " " + order->get_str() : quoted(tree.arguments[0])) +
                             ", an integer from 0 to " + std::to_string(largest_stumpff_order) + " is required",
                         tree.where, "stumpff(k, z) is the sum over j of (-z)^j / (2j+k)!");
    return graph.stumpff(static_cast<unsigned>(order->get_num().get_ui()), arguments[1]);
}

/// One component of A^-1 b; equal systems are one node, whichever component asks first.
NodeId lower_solve(Graph& graph, const TreeNode& tree, std::span<const NodeId> arguments)
{
    const std::size_t n = solve_order(arguments.size());
    if (n * n + n != arguments.size() || sgn(tree.number) < 0 || tree.number >= n)
        throw InternalError("a solve with " + std::to_string(arguments.size()) + " arguments");
    try {
        const auto z = graph.solve(arguments.first(n * n), arguments.last(n), MatrixStructure::general);
        return z[tree.number.get_num().get_ui()];
    } catch (const DivisionByZero&) {
        throw ModelError("the matrix of a linear system has an entry 0 that is alone in its row and column, a matrix "
                         "with an inverse is required",
                         tree.where);
    }
}

NodeId lower_call(Graph& graph, const TreeNode& tree, std::span<const NodeId> arguments)
{
    if (tree.function == Function::stumpff) return lower_stumpff(graph, tree, arguments);
    const Op op = op_of(tree.function);
    switch (arguments.size()) {
    case 1: return graph.apply(op, arguments[0]);
    case 2: return graph.apply(op, arguments[0], arguments[1]);
    default: return graph.select(arguments[0], arguments[1], arguments[2]);
    }
}

/// The node of a tree from the nodes of its arguments.
NodeId combine(Graph& graph, const TreeNode& tree, std::span<const NodeId> arguments, const Binding& binding)
{
    switch (tree.kind) {
    case TreeKind::number: return graph.constant(tree.number);
    case TreeKind::pi: return graph.pi();
    case TreeKind::name: {
        const auto bound = binding.find(tree.name);
        return bound != binding.end() ? bound->second : graph.input(tree.name);
    }
    case TreeKind::negate: return graph.negate(arguments[0]);
    case TreeKind::add: return graph.sum(arguments);
    case TreeKind::multiply: return graph.product(arguments);
    case TreeKind::divide: return lower_divide(graph, tree, arguments[0], arguments[1]);
    case TreeKind::power: return lower_power(graph, tree, arguments[0], arguments[1]);
    case TreeKind::call: return lower_call(graph, tree, arguments);
    case TreeKind::solve: return lower_solve(graph, tree, arguments);
    case TreeKind::compare: return graph.apply(op_of(tree.comparison), arguments[0], arguments[1]);
    default: break;
    }
    throw InternalError("lowering wants a closed scalar tree, found " + (tree.name.empty() ? "a vector" : tree.name));
}

} // namespace

NodeId Lowering::operator()(const Tree& tree)
{
    return nodes_(tree, [this](const Tree& part, const std::vector<NodeId>& arguments) {
        return combine(graph_, *part, arguments, binding_);
    });
}

} // namespace lagen
