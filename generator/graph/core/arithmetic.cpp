// SPDX-License-Identifier: GPL-2.0-or-later
/// Sums, products, quotients and integer powers, with their local rules. Every rule is exact in floating point too, or
/// folds exact constants.
#include "graph/core/graph.hpp"
#include "graph/core/special_values.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// Constants are folded up to this size; beyond it the operation stays (x = x * x in a loop doubles the digits).
constexpr std::size_t folded_bits = std::size_t{1} << 16U;

bool foldable(const Graph& graph, NodeId a, NodeId b)
{
    return graph.is_constant(a) && graph.is_constant(b) &&
           bits_of(graph.value(a)) + bits_of(graph.value(b)) <= folded_bits;
}

bool is_negative(const Graph& graph, NodeId id)
{
    return graph.is_constant(id) && sgn(graph.value(id)) < 0;
}

} // namespace

NodeId Graph::add(NodeId a, NodeId b)
{
    if (is_zero(a)) return b;
    if (is_zero(b)) return a;
    if (foldable(*this, a, b)) return constant(Rational(value(a) + value(b)));
    if (a == b) return multiply(constant(2), a);
    if (ops_[b] == Op::negate) return subtract(a, operands(b)[0]);
    if (ops_[a] == Op::negate) return subtract(b, operands(a)[0]);
    if (is_negative(*this, b)) return subtract(a, constant(Rational(-value(b))));
    if (is_negative(*this, a)) return subtract(b, constant(Rational(-value(a))));
    const NodeId pair[] = {a, b};
    return intern(Op::add, pair, 0);
}

NodeId Graph::subtract(NodeId a, NodeId b)
{
    if (is_zero(b)) return a;
    if (is_zero(a)) return negate(b);
    if (a == b) return constant(0);
    if (foldable(*this, a, b)) return constant(Rational(value(a) - value(b)));
    if (ops_[b] == Op::negate) return add(a, operands(b)[0]);
    if (ops_[a] == Op::negate) return negate(add(operands(a)[0], b));
    if (is_negative(*this, b)) return add(a, constant(Rational(-value(b))));
    const NodeId pair[] = {a, b};
    return intern(Op::subtract, pair, 0);
}

NodeId Graph::negate(NodeId a)
{
    if (is_constant(a)) return constant(Rational(-value(a)));
    if (ops_[a] == Op::negate) return operands(a)[0];
    if (ops_[a] == Op::subtract) return subtract(operands(a)[1], operands(a)[0]);
    const NodeId only[] = {a};
    return intern(Op::negate, only, 0);
}

NodeId Graph::multiply(NodeId a, NodeId b)
{
    if (is_zero(a) || is_zero(b)) return constant(0);
    if (is_one(a)) return b;
    if (is_one(b)) return a;
    if (foldable(*this, a, b)) return constant(Rational(value(a) * value(b)));
    if (is_constant(b)) std::swap(a, b);
    if (is_negative(*this, a)) return negate(multiply(constant(Rational(-value(a))), b));
    if (ops_[a] == Op::negate) return negate(multiply(operands(a)[0], b));
    if (ops_[b] == Op::negate) return negate(multiply(a, operands(b)[0]));
    if (a == b) return power(a, 2);
    if (is_constant(a) && ops_[b] == Op::multiply)
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
            if (const NodeId inner = operands(b)[k]; foldable(*this, a, inner)) {
                const NodeId rest = operands(b)[1 - k];
                return multiply(constant(Rational(value(a) * value(inner))), rest);
            }
    const NodeId pair[] = {a, b};
    return intern(Op::multiply, pair, 0);
}

NodeId Graph::divide(NodeId a, NodeId b)
{
    if (is_zero(b))
        throw DivisionByZero("division by zero: the divisor is the constant 0, a divisor other than 0 is required");
    if (is_zero(a) || is_one(b)) return a;
    if (a == b) return constant(1);
    if (foldable(*this, a, b)) return constant(Rational(value(a) / value(b)));
    if (is_negative(*this, b)) return negate(divide(a, constant(Rational(-value(b)))));
    if (is_negative(*this, a)) return negate(divide(constant(Rational(-value(a))), b));
    if (ops_[a] == Op::negate) return negate(divide(operands(a)[0], b));
    if (ops_[b] == Op::negate) return negate(divide(a, operands(b)[0]));
    // 0/b is 0 where it stands alone, and so it is as a choice.
    if (ops_[a] == Op::select && (is_zero(operands(a)[1]) || is_zero(operands(a)[2]))) {
        const NodeId of[] = {operands(a)[0], operands(a)[1], operands(a)[2]};
        return select(of[0], divide(of[1], b), divide(of[2], b));
    }
    // Both overflow where their quotient does not.
    if (ops_[a] == Op::sinh && ops_[b] == Op::cosh && operands(a)[0] == operands(b)[0])
        return apply(Op::tanh, operands(a)[0]);
    const NodeId pair[] = {a, b};
    return intern(Op::divide, pair, 0);
}

NodeId Graph::power(NodeId a, int exponent)
{
    if (exponent == 0) return constant(1);
    if (exponent == 1) return a;
    if (is_zero(a) && exponent < 0)
        throw DivisionByZero("division by zero: 0^" + std::to_string(exponent) + ", a base other than 0 is required");
    const auto magnitude = static_cast<std::size_t>(exponent < 0 ? -std::int64_t{exponent} : std::int64_t{exponent});
    if (is_zero(a) || is_one(a)) return a;
    if (is_constant(a) && bits_of(value(a)) <= folded_bits / magnitude)
        return constant(*rules::exact_power(value(a), exponent, folded_bits));
    if (ops_[a] == Op::negate) {
        const NodeId positive = power(operands(a)[0], exponent);
        return exponent % 2 == 0 ? positive : negate(positive);
    }
    if (ops_[a] == Op::sqrt && exponent % 2 == 0) return power(operands(a)[0], exponent / 2);
    if (exponent % 2 == 0 && (ops_[a] == Op::divide || ops_[a] == Op::multiply))
        if (const auto square = rules::special_square(*this, a)) return power(constant(*square), exponent / 2);
    if (ops_[a] == Op::power) {
        const std::int64_t product = std::int64_t{exponent} * static_cast<std::int32_t>(payloads_[a]);
        if (product > -INT32_MAX && product < INT32_MAX) return power(operands(a)[0], static_cast<int>(product));
    }
    const NodeId only[] = {a};
    return intern(Op::power, only, static_cast<std::uint32_t>(exponent));
}

} // namespace lagen
