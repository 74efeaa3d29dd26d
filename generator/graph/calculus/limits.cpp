// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/calculus/limits.hpp"

#include "graph/core/operators.hpp"

#include <algorithm>

namespace lagen {

namespace {

constexpr int has_derivative = 2;    ///< an exponent above 1
constexpr int identically_zero = 99; ///< the order of the zeros of 0
constexpr int deepest_walk = 32;

std::int32_t exponent_in(const Graph& graph, NodeId power)
{
    return static_cast<std::int32_t>(graph.payload(power));
}

/// p of a^p, a real power or a square root; nothing where it is no number.
std::optional<Rational> real_exponent(const Graph& graph, NodeId node)
{
    if (graph.op(node) == Op::sqrt) return Rational(1, 2);
    const NodeId exponent = graph.operands(node)[1];
    return graph.is_constant(exponent) ? std::optional(graph.value(exponent)) : std::nullopt;
}

} // namespace

Limits::Limits(Graph& graph, std::span<const NodeId> outputs, const std::vector<NodeId>& nodes,
               const std::vector<bool>& active)
    : graph_(graph), active_(active), divides_(active.size(), false), orders_(active.size()),
      exponents_(active.size(), Rational(has_derivative))
{
    find_divisors(outputs, nodes);
    for (const NodeId node : nodes) {
        orders_[node] = order_of(node);
        if (active_[node]) exponents_[node] = exponent_of(node);
    }
}

void Limits::find_divisors(std::span<const NodeId> outputs, const std::vector<NodeId>& nodes)
{
    for (const NodeId node : certainly_needed(graph_, outputs)) {
        const Op op = graph_.op(node);
        if (op == Op::divide) divides_[graph_.operands(node)[1]] = true;
        const bool negative = op == Op::power && exponent_in(graph_, node) < 0;
        if (negative || op == Op::log) divides_[graph_.operands(node)[0]] = true;
    }
    for (std::size_t k = nodes.size(); k-- > 0;) {
        const NodeId node = nodes[k];
        if (!divides_[node]) continue;
        const auto operands = graph_.operands(node);
        if (graph_.op(node) == Op::multiply) divides_[operands[1]] = divides_[operands[0]] = true;
        if (operator_of(graph_.op(node)).vanishes_with_operand) divides_[operands[0]] = true;
    }
}

/// Of a node whose operands have theirs. What does not move is taken to be positive: a radicand has to be.
std::optional<Rational> Limits::order_of(NodeId node) const
{
    const auto operands = graph_.operands(node);
    const auto order = [&](std::size_t k) { return orders_[operands[k]]; };
    const auto least = [&](std::size_t j, std::size_t k) {
        return order(j) && order(k) ? std::optional(std::min(*order(j), *order(k))) : std::nullopt;
    };
    if (graph_.is_constant(node)) {
        const int sign = sgn(graph_.value(node));
        return sign < 0 ? std::nullopt : std::optional<Rational>(sign > 0 ? 0 : identically_zero);
    }
    if (!active_[node]) return Rational(0);
    switch (graph_.op(node)) {
    case Op::exp:
    case Op::cosh: return Rational(0);
    case Op::abs: return order(0).value_or(1);
    case Op::sqrt: return Rational(order(0).value_or(1) / 2);
    case Op::power: {
        const std::int32_t n = exponent_in(graph_, node);
        if (!order(0) && n % 2 != 0) return std::nullopt;
        return n < 0 ? Rational(0) : Rational(n * order(0).value_or(1));
    }
    case Op::real_power: {
        const auto p = real_exponent(graph_, node);
        return p ? Rational(std::max(Rational(0), *p) * order(0).value_or(1)) : order(0).value_or(1);
    }
    case Op::multiply: // where one factor vanishes the other need not
        if (!order(0) || !order(1)) return std::nullopt;
        return *order(0) == 0 ? *order(1) : *order(1) == 0 ? *order(0) : *least(0, 1);
    case Op::divide: return order(1) ? order(0) : std::nullopt;
    case Op::add:
    case Op::minimum: return least(0, 1);
    case Op::select: return least(1, 2);
    case Op::maximum:
        if (!order(0) && !order(1)) return std::nullopt;
        return order(0) == Rational(0) || order(1) == Rational(0) ? Rational(0) : Rational(1);
    default: return std::nullopt;
    }
}

/// q at the zeros of a root or modulus of something that has a derivative.
Rational Limits::own_exponent(NodeId node) const
{
    if (graph_.op(node) == Op::abs) return 1;
    const auto p = real_exponent(graph_, node);
    if (!p || *p <= 0 || *p >= 1) return has_derivative;
    return std::min(Rational(1), Rational(*p * orders_[graph_.operands(node)[0]].value_or(1)));
}

/// A root that goes to 0 faster than the distance has the derivative 0 there: (x^4 + y^4)^(1/2).
bool Limits::is_flat_root(NodeId node) const
{
    const Op op = graph_.op(node);
    if ((op != Op::sqrt && op != Op::real_power) || divides_[node]) return false;
    const NodeId radicand = graph_.operands(node)[0];
    const auto p = real_exponent(graph_, node);
    const auto order = orders_[radicand];
    return !divides_[radicand] && !is_rough(radicand) && p && *p < 1 && order && *p * *order > 1;
}

/// Of a node whose operands have theirs: a radicand that changes its sign ends where it vanishes.
Rational Limits::exponent_of(NodeId node) const
{
    const Op op = graph_.op(node);
    if (kind_of(op) == OpKind::comparison || op == Op::sign) return has_derivative;
    const auto operands = graph_.operands(node);
    Rational least = has_derivative;
    for (const NodeId operand : operands.subspan(op == Op::select ? 1 : 0))
        if (operand < exponents_.size()) least = std::min(least, exponents_[operand]);
    const bool root = op == Op::sqrt || op == Op::real_power;
    if ((!root && op != Op::abs) || divides_[node] || divides_[operands[0]]) return least;
    const auto order = orders_[operands[0]];
    if (order == Rational(0) || (root && !order) || is_flat_root(node)) return least;
    const Rational own = own_exponent(node);
    return std::min(own, least <= 1 && root ? Rational(least * own) : least);
}

/// Is the k-th term of the derivative of a node 0 where its outer factor is?
bool Limits::needs_limit(NodeId node, std::size_t k) const
{
    const auto operands = graph_.operands(node);
    const Rational q = exponents_[operands[k]];
    const auto joins = [&](NodeId outer) { return active_[outer] && std::min(Rational(1), exponents_[outer]) + q > 1; };
    switch (graph_.op(node)) {
    case Op::multiply: {
        const NodeId outer = operands[1 - k], inner = operands[k];
        const bool own = graph_.op(inner) == Op::sqrt && graph_.operands(inner)[0] == outer && !divides_[inner];
        return own || (q <= 1 && joins(outer));
    }
    case Op::divide: return k == 1 && q <= 1 && joins(operands[0]);
    case Op::power: {
        const std::int32_t n = exponent_in(graph_, node);
        const bool own = graph_.op(operands[0]) == Op::sqrt && n >= 3 && !divides_[operands[0]];
        return own || (q <= 1 && n >= 2 && n * q > 1);
    }
    case Op::real_power: {
        const auto p = real_exponent(graph_, node);
        return k == 0 && q <= 1 && (q == 1 || (p && *p * q > 1));
    }
    case Op::sqrt:
    case Op::abs:
    case Op::minimum:
    case Op::maximum: return false;
    default: return q <= 1 && 2 * q > 1 && kind_of(graph_.op(node)) == OpKind::function;
    }
}

NodeId Limits::where_not_zero(NodeId outer, NodeId value)
{
    const NodeId zero = graph_.constant(0);
    return graph_.select(graph_.apply(Op::equal, outer, zero), zero, value);
}

/// Where the node is 0 in a whole neighbourhood, as its minima, maxima and selections show; nothing where nowhere.
std::optional<NodeId> Limits::flat_where(NodeId node, int depth)
{
    if (depth == 0) return std::nullopt;
    const NodeId zero = graph_.constant(0);
    const std::vector<NodeId> of(graph_.operands(node).begin(), graph_.operands(node).end());
    const auto flat = [&](std::size_t k) { return flat_where(of[k], depth - 1); };
    switch (const Op op = graph_.op(node)) {
    case Op::maximum:
    case Op::minimum:
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
            if (graph_.is_zero(of[k]))
                return graph_.apply(op == Op::maximum ? Op::less_equal : Op::greater_equal, of[1 - k], zero);
        return std::nullopt;
    case Op::select:
        if (graph_.is_zero(of[1])) return of[0];
        return graph_.is_zero(of[2]) ? std::optional(graph_.apply(Op::equal, of[0], zero)) : std::nullopt;
    case Op::multiply: {
        const auto a = flat(0), b = flat(1);
        return a && b ? graph_.add(*a, *b) : a ? a : b;
    }
    case Op::add:
    case Op::subtract: {
        const auto a = flat(0), b = a ? flat(1) : std::nullopt;
        return b ? std::optional(graph_.multiply(*a, *b)) : std::nullopt;
    }
    case Op::negate:
    case Op::divide:
    case Op::power:
    case Op::sqrt:
    case Op::abs: return flat(0);
    default: return std::nullopt;
    }
}

NodeId Limits::contribution(NodeId node, std::size_t k, NodeId tangent)
{
    const Op op = graph_.op(node);
    const auto rule = operator_of(op).contribution;
    if (k == 0 && (op == Op::sqrt || op == Op::abs || op == Op::real_power))
        if (const auto flat = flat_where(graph_.operands(node)[0], deepest_walk))
            return graph_.select(*flat, graph_.constant(0), rule(graph_, node, k, tangent));
    if (k == 0 && is_flat_root(node)) return where_not_zero(graph_.operands(node)[0], rule(graph_, node, k, tangent));
    if (!needs_limit(node, k)) return rule(graph_, node, k, tangent);
    switch (op) {
    case Op::multiply: return where_not_zero(graph_.operands(node)[1 - k], rule(graph_, node, k, tangent));
    case Op::divide:
    case Op::power: return where_not_zero(graph_.operands(node)[0], rule(graph_, node, k, tangent));
    default: {
        const NodeId slope = rule(graph_, node, k, graph_.constant(1));
        return where_not_zero(slope, graph_.multiply(slope, tangent));
    }
    }
}

} // namespace lagen
