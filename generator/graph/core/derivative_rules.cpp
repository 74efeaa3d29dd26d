// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/core/derivative_rules.hpp"

namespace lagen::rules {
namespace {

NodeId operand(const Graph& g, NodeId node, std::size_t k)
{
    return g.operands(node)[k];
}

/// 1 - a^2, under the roots of the inverse sine and cosine.
NodeId complement(Graph& g, NodeId a)
{
    return g.subtract(g.constant(1), g.power(a, 2));
}

} // namespace

/// t * sign: the rule of a sum, difference or minus sign.
NodeId of_add(Graph&, NodeId, std::size_t, NodeId t)
{
    return t;
}
NodeId of_subtract(Graph& g, NodeId, std::size_t k, NodeId t)
{
    return k == 0 ? t : g.negate(t);
}
NodeId of_negate(Graph& g, NodeId, std::size_t, NodeId t)
{
    return g.negate(t);
}
NodeId of_multiply(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    return g.multiply(operand(g, node, 1 - k), t);
}

/// d(a/b) = da/b - (a/b) db/b.
NodeId of_divide(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId b = operand(g, node, 1);
    return k == 0 ? g.divide(t, b) : g.negate(g.divide(g.multiply(node, t), b));
}

/// d(a^n) = n a^(n-1) da.
NodeId of_power(Graph& g, NodeId node, std::size_t, NodeId t)
{
    const auto n = static_cast<std::int32_t>(g.payload(node));
    const NodeId a = operand(g, node, 0);
    if (n == INT32_MIN) return g.multiply(g.multiply(g.constant(n), g.divide(node, a)), t);
    return g.multiply(g.multiply(g.constant(n), g.power(a, n - 1)), t);
}

/// d(a^b) = b a^(b-1) da + a^b log(a) db.
NodeId of_real_power(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId a = operand(g, node, 0);
    const NodeId b = operand(g, node, 1);
    if (k == 1) return g.multiply(g.multiply(node, g.apply(Op::log, a)), t);
    const NodeId lower = g.apply(Op::real_power, a, g.subtract(b, g.constant(1)));
    return g.multiply(g.multiply(b, lower), t);
}

NodeId of_sqrt(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.divide(t, g.multiply(g.constant(2), node));
}
NodeId of_sin(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.apply(Op::cos, operand(g, node, 0)), t);
}
NodeId of_cos(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.negate(g.multiply(g.apply(Op::sin, operand(g, node, 0)), t));
}
NodeId of_tan(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.add(g.constant(1), g.power(node, 2)), t);
}

NodeId of_asin(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.divide(t, g.apply(Op::sqrt, complement(g, operand(g, node, 0))));
}
NodeId of_acos(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    return g.negate(of_asin(g, node, k, t));
}
NodeId of_atan(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.divide(t, g.add(g.constant(1), g.power(operand(g, node, 0), 2)));
}

/// d atan2(y, x) = (x dy - y dx) / (x^2 + y^2).
NodeId of_atan2(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId y = operand(g, node, 0);
    const NodeId x = operand(g, node, 1);
    const NodeId square = g.add(g.power(x, 2), g.power(y, 2));
    return k == 0 ? g.divide(g.multiply(x, t), square) : g.negate(g.divide(g.multiply(y, t), square));
}

NodeId of_sinh(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.apply(Op::cosh, operand(g, node, 0)), t);
}
NodeId of_cosh(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.apply(Op::sinh, operand(g, node, 0)), t);
}
NodeId of_tanh(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(complement(g, node), t);
}
NodeId of_exp(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(node, t);
}
NodeId of_log(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.divide(t, operand(g, node, 0));
}
NodeId of_abs(Graph& g, NodeId node, std::size_t, NodeId t)
{
    return g.multiply(g.divide(operand(g, node, 0), node), t);
}

/// c_k' = (k c_{k+2} - c_{k+1}) / 2.
NodeId of_stumpff(Graph& g, NodeId node, std::size_t, NodeId t)
{
    const unsigned k = g.payload(node);
    const NodeId z = operand(g, node, 0);
    NodeId slope = g.negate(g.stumpff(k + 1, z));
    if (k != 0) slope = g.add(g.multiply(g.constant(static_cast<long>(k)), g.stumpff(k + 2, z)), slope);
    return g.multiply(g.divide(slope, g.constant(2)), t);
}

/// 2/sqrt(pi) exp(-a^2) da.
NodeId of_erf(Graph& g, NodeId node, std::size_t, NodeId t)
{
    const NodeId bell = g.apply(Op::exp, g.negate(g.power(operand(g, node, 0), 2)));
    const NodeId height = g.divide(g.constant(2), g.apply(Op::sqrt, g.pi()));
    return g.multiply(g.multiply(height, bell), t);
}

/// The branch that is taken; where both are equal, the first.
NodeId of_minimum(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId first = g.apply(Op::less_equal, operand(g, node, 0), operand(g, node, 1));
    const NodeId zero = g.constant(0);
    return k == 0 ? g.select(first, t, zero) : g.select(first, zero, t);
}
NodeId of_maximum(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId first = g.apply(Op::greater_equal, operand(g, node, 0), operand(g, node, 1));
    const NodeId zero = g.constant(0);
    return k == 0 ? g.select(first, t, zero) : g.select(first, zero, t);
}
NodeId of_step(Graph& g, NodeId, std::size_t, NodeId)
{
    return g.constant(0);
}
NodeId of_select(Graph& g, NodeId node, std::size_t k, NodeId t)
{
    const NodeId condition = operand(g, node, 0);
    const NodeId zero = g.constant(0);
    if (k == 0) return zero;
    return k == 1 ? g.select(condition, t, zero) : g.select(condition, zero, t);
}

NodeId slope_one(Graph& g, NodeId, std::size_t)
{
    return g.constant(1);
}
NodeId slope_of_erf(Graph& g, NodeId, std::size_t)
{
    return g.constant(Rational(9, 8));
}
NodeId slope_of_root(Graph& g, NodeId node, std::size_t)
{
    return g.divide(g.constant(Rational(1, 2)), node);
}
NodeId slope_of_log(Graph& g, NodeId node, std::size_t)
{
    return g.divide(g.constant(1), g.apply(Op::abs, operand(g, node, 0)));
}
NodeId slope_is_value(Graph&, NodeId node, std::size_t)
{
    return node;
}
NodeId slope_of_sinh(Graph& g, NodeId node, std::size_t)
{
    return g.add(g.apply(Op::abs, node), g.constant(1));
}
NodeId slope_of_tan(Graph& g, NodeId node, std::size_t)
{
    return g.add(g.power(node, 2), g.constant(1));
}
NodeId slope_of_real_power(Graph& g, NodeId node, std::size_t k)
{
    if (k == 1) return g.apply(Op::abs, of_real_power(g, node, 1, g.constant(1)));
    return g.apply(Op::abs, g.divide(g.multiply(operand(g, node, 1), node), operand(g, node, 0)));
}
NodeId slope_of_inverse_sine(Graph& g, NodeId node, std::size_t)
{
    return g.divide(g.constant(1), g.apply(Op::sqrt, complement_of(g, node)));
}

NodeId complement_of(Graph& g, NodeId node)
{
    return complement(g, operand(g, node, 0));
}

} // namespace lagen::rules
