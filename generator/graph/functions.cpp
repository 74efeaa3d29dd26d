// SPDX-License-Identifier: GPL-2.0-or-later
/// Elementary functions, comparisons and selection, with the exact values at constants that are certain.
#include "expression/evaluate_stumpff.hpp"
#include "graph/graph.hpp"
#include "graph/operators.hpp"

#include <algorithm>
#include <optional>

namespace lagen {
namespace {

/// The rational square root, where there is one.
std::optional<Rational> exact_root(const Rational& value)
{
    if (sgn(value) < 0 || mpz_perfect_square_p(value.get_num_mpz_t()) == 0 ||
        mpz_perfect_square_p(value.get_den_mpz_t()) == 0)
        return std::nullopt;
    return Rational(sqrt(value.get_num()), sqrt(value.get_den()));
}

std::optional<Rational> exact_value(Op op, const Rational& a)
{
    switch (op) {
    case Op::sqrt: return exact_root(a);
    case Op::abs: return Rational(abs(a));
    case Op::sign: return Rational(sgn(a));
    case Op::sin:
    case Op::tan:
    case Op::asin:
    case Op::atan:
    case Op::sinh:
    case Op::tanh: return a == 0 ? std::optional<Rational>(0) : std::nullopt;
    case Op::cos:
    case Op::cosh:
    case Op::exp: return a == 0 ? std::optional<Rational>(1) : std::nullopt;
    case Op::acos:
    case Op::log: return a == 1 ? std::optional<Rational>(0) : std::nullopt;
    default: return std::nullopt;
    }
}

std::optional<Rational> exact_value(Op op, const Rational& a, const Rational& b)
{
    switch (op) {
    case Op::minimum: return a <= b ? a : b;
    case Op::maximum: return a >= b ? a : b;
    case Op::less: return Rational(a < b ? 1 : 0);
    case Op::less_equal: return Rational(a <= b ? 1 : 0);
    case Op::greater: return Rational(a > b ? 1 : 0);
    case Op::greater_equal: return Rational(a >= b ? 1 : 0);
    case Op::equal: return Rational(a == b ? 1 : 0);
    case Op::not_equal: return Rational(a != b ? 1 : 0);
    case Op::atan2: return a == 0 && b > 0 ? std::optional<Rational>(0) : std::nullopt;
    default: return std::nullopt;
    }
}

} // namespace

NodeId Graph::apply(Op op, NodeId a)
{
    if (op == Op::negate) return negate(a);
    if (operator_of(op).arity != 1 || operator_of(op).notation != Notation::call || op == Op::stumpff)
        throw InternalError(std::string("apply(op, a) wants a function of one operand, not ") + operator_of(op).name);
    if (is_constant(a))
        if (const auto known = exact_value(op, value(a))) return constant(*known);
    if (op == Op::abs && (ops_[a] == Op::abs || ops_[a] == Op::sqrt)) return a;
    if (op == Op::abs && ops_[a] == Op::negate) return apply(op, operands(a)[0]);
    if (op == Op::sqrt && ops_[a] == Op::power && payloads_[a] == 2) return apply(Op::abs, operands(a)[0]);
    const NodeId only[] = {a};
    return intern(op, only, 0);
}

NodeId Graph::apply(Op op, NodeId a, NodeId b)
{
    switch (op) {
    case Op::add: return add(a, b);
    case Op::subtract: return subtract(a, b);
    case Op::multiply: return multiply(a, b);
    case Op::divide: return divide(a, b);
    default: break;
    }
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
    if (is_constant(a) && is_constant(b))
        if (const auto known = exact_value(op, value(a), value(b))) return constant(*known);
    if ((op == Op::minimum || op == Op::maximum) && a == b) return a;
    if (operator_of(op).commutative && a > b) std::swap(a, b);
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

} // namespace lagen
