// SPDX-License-Identifier: GPL-2.0-or-later
/// Elementary functions, comparisons and selection, with the exact values at constants that are certain.
#include "expression/evaluate_stumpff.hpp"
#include "graph/core/graph.hpp"
#include "graph/core/operators.hpp"
#include "graph/core/special_values.hpp"

#include <algorithm>
#include <limits>

namespace lagen {

namespace {

constexpr std::size_t any_length = std::numeric_limits<std::size_t>::max();

} // namespace

NodeId Graph::apply(Op op, NodeId a)
{
    if (op == Op::negate) return negate(a);
    if (operator_of(op).arity != 1 || operator_of(op).notation != Notation::call || op == Op::stumpff)
        throw InternalError(std::string("apply(op, a) wants a function of one operand, not ") + operator_of(op).name);
    if (is_constant(a))
        if (const auto known = exact_value(op, &value(a), 0, any_length)) return constant(*known);
    if (const auto known = rules::special_value(*this, op, a)) return *known;
    if (op == Op::abs && (ops_[a] == Op::abs || ops_[a] == Op::sqrt)) return a;
    if (op == Op::abs && ops_[a] == Op::negate) return apply(op, operands(a)[0]);
    if (ops_[a] == Op::power && (op == Op::abs || op == Op::sqrt)) {
        // |x^n| = |x|^n, x^n where n is even; sqrt(x^2n) = |x^n|
        const auto n = static_cast<std::int32_t>(payloads_[a]);
        const NodeId base = operands(a)[0];
        if (op == Op::abs) return n % 2 == 0 ? a : power(apply(Op::abs, base), n);
        if (n % 2 == 0) return apply(Op::abs, power(base, n / 2));
    }
    const NodeId only[] = {a};
    return intern(op, only, 0);
}

NodeId Graph::apply(Op op, NodeId a, NodeId b)
{
    if (op == Op::add) return add(a, b);
    if (op == Op::subtract) return subtract(a, b);
    if (op == Op::multiply) return multiply(a, b);
    if (op == Op::divide) return divide(a, b);
    if (operator_of(op).arity != 2)
        throw InternalError(std::string("apply(op, a, b) wants a function of two operands, not ") +
                            operator_of(op).name);
    if (op == Op::real_power && is_constant(b)) {
        // Integer exponents are powers, half-integer ones powers of the root: both defined where a^b is.
        const Rational& exponent = value(b);
        const bool half = exponent.get_den() == 2;
        if ((half || exponent.get_den() == 1) && exponent.get_num().fits_sint_p()) {
            const auto n = static_cast<int>(exponent.get_num().get_si());
            return half ? power(apply(Op::sqrt, a), n) : power(a, n);
        }
    }
    if (op == Op::real_power && is_one(a)) return a;
    if (is_constant(a) && is_constant(b)) {
        const Rational both[] = {value(a), value(b)};
        if (const auto known = exact_value(op, both, 0, any_length)) return constant(*known);
    }
    if (op == Op::atan2)
        if (const auto known = rules::special_angle(*this, a, b)) return *known;
    if ((op == Op::minimum || op == Op::maximum) && a == b) return a;
    const NodeId pair[] = {a, b};
    return intern(op, pair, 0);
}

NodeId Graph::stumpff(unsigned k, NodeId z)
{
    if (k > largest_stumpff_order)
        throw MathematicsError("stumpff(" + std::to_string(k) + ", z) is beyond the order " +
                               std::to_string(largest_stumpff_order) + ", the highest there is");
    if (is_zero(z)) return constant(stumpff_at_zero(k));
    const NodeId only[] = {z};
    return intern(Op::stumpff, only, k);
}

NodeId Graph::select(NodeId condition, NodeId a, NodeId b)
{
    if (a == b) return a;
    if (is_constant(condition)) return is_zero(condition) ? b : a;
    const NodeId operands[] = {condition, a, b};
    return intern(Op::select, operands, 0);
}

NodeId Graph::make(Op op, std::uint32_t payload, std::span<const NodeId> operands)
{
    switch (kind_of(op)) {
    case OpKind::leaf:
    case OpKind::system: break;
    case OpKind::power: return power(operands[0], static_cast<std::int32_t>(payload));
    case OpKind::choice: return select(operands[0], operands[1], operands[2]);
    case OpKind::sum:
    case OpKind::product:
    case OpKind::quotient:
    case OpKind::function:
    case OpKind::comparison:
        if (op == Op::stumpff) return stumpff(payload, operands[0]);
        return operands.size() == 1 ? apply(op, operands[0]) : apply(op, operands[0], operands[1]);
    }
    throw InternalError(std::string("no node is made of ") + operator_of(op).name + " alone");
}

} // namespace lagen
