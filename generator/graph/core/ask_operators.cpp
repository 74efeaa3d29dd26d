// SPDX-License-Identifier: GPL-2.0-or-later
/// The questions that are asked of the operator table.
#include "graph/core/operators.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lagen {

Op op_of(Function function)
{
    const auto row = std::ranges::find(operator_table(), std::optional(function), &Operator::function);
    if (row == operator_table().end()) throw InternalError("a built-in function without an operation");
    return row->op;
}

Op op_of(Comparison comparison)
{
    return std::ranges::find(operator_table(), std::optional(comparison), &Operator::comparison)->op;
}

bool is_rational(Op op)
{
    switch (kind_of(op)) {
    case OpKind::leaf:
    case OpKind::sum:
    case OpKind::product:
    case OpKind::quotient:
    case OpKind::power: return true;
    case OpKind::function:
    case OpKind::comparison:
    case OpKind::choice:
    case OpKind::system: break;
    }
    return false;
}

Sense domain_of(const Graph& graph, NodeId node)
{
    const Operator& row = operator_of(graph.op(node));
    return row.domain != nullptr ? row.domain(graph, node) : Sense::always;
}

Sense known_where_defined(const Graph& graph, NodeId node)
{
    if (graph.op(node) == Op::real_power) {
        const NodeId exponent = graph.operands(node)[1];
        if (!graph.is_constant(exponent) || graph.value(exponent).get_den() == 1) return Sense::always;
    }
    return domain_of(graph, node);
}

Sense smooth_where(const Graph& graph, NodeId node)
{
    switch (operator_of(graph.op(node)).smoothness) {
    case Smoothness::meromorphic:
    case Smoothness::analytic: {
        const Sense domain = domain_of(graph, node);
        return domain == Sense::nonnegative ? Sense::positive : domain;
    }
    case Smoothness::cut: return Sense::off_cut;
    case Smoothness::kinked:
    case Smoothness::stepped: return Sense::nonzero;
    case Smoothness::chosen: return Sense::same_branch;
    case Smoothness::system: break;
    }
    return domain_of(graph, node);
}

NodeId condition_of(Graph& graph, NodeId node)
{
    const Operator& row = operator_of(graph.op(node));
    return row.condition_operand >= 0 ? graph.operands(node)[static_cast<std::size_t>(row.condition_operand)]
                                      : row.condition(graph, node);
}

NodeId slope_bound(Graph& graph, NodeId node, std::size_t k)
{
    const Operator& row = operator_of(graph.op(node));
    if (row.slope != nullptr) return row.slope(graph, node, k);
    return graph.apply(Op::abs, row.contribution(graph, node, k, graph.constant(1)));
}

int power_multiplications(std::int64_t n)
{
    const auto bits = static_cast<std::uint64_t>(n);
    return static_cast<int>(std::bit_width(bits)) + std::popcount(bits) - 2;
}

double operation_weight(const Graph& graph, NodeId node)
{
    const Op op = graph.op(node);
    if (op == Op::power) {
        const auto n = static_cast<std::int32_t>(graph.payload(node));
        return n < 0 ? operator_of(Op::divide).weight + power_multiplications(-std::int64_t{n})
                     : power_multiplications(n);
    }
    if (op == Op::factor) {
        const double n = std::sqrt(static_cast<double>(graph.operands(node).size()));
        const bool general = graph.payload(node) == static_cast<std::uint32_t>(MatrixStructure::general);
        const double waits = std::max(0.0, n - 3); // a pivot waits for the one before; orders up to 3 are closed forms
        return n * n * n / (general ? 3 : 6) + operator_of(Op::divide).weight * (n + waits);
    }
    if (op == Op::solve) {
        const auto n = static_cast<double>(graph.operands(node).size() - 1);
        return 2 * n * n;
    }
    return operator_of(op).weight;
}

double operation_latency(const Graph& graph, NodeId node)
{
    if (graph.op(node) != Op::power) return operator_of(graph.op(node)).latency;
    const auto n = static_cast<std::int32_t>(graph.payload(node));
    return operator_of(Op::multiply).latency * power_multiplications(std::abs(std::int64_t{n})) +
           (n < 0 ? operator_of(Op::divide).latency : 0);
}

} // namespace lagen
