// SPDX-License-Identifier: GPL-2.0-or-later
/// Ball arithmetic, node by node. Arb answers "not finite" for every argument outside a function's domain, and so it
/// spreads to all that depends on it.
#include "proof/enclosure.hpp"

#include <arb_mat.h>

#include <cmath>
#include <limits>

namespace lagen::proof {

namespace {

/// 1 or 0 where `yes` or `no` is certain.
Ball decided(bool yes, bool no)
{
    Ball result;
    if (yes || no) {
        arb_set_ui(result.get(), yes ? 1 : 0);
    } else {
        arb_indeterminate(result.get());
    }
    return result;
}

Ball compare(Op op, const Ball& a, const Ball& b)
{
    arb_srcptr x = a.get();
    arb_srcptr y = b.get();
    if (!a.is_finite() || !b.is_finite()) return decided(false, false);
    switch (op) {
    case Op::less: return decided(arb_lt(x, y) != 0, arb_ge(x, y) != 0);
    case Op::less_equal: return decided(arb_le(x, y) != 0, arb_gt(x, y) != 0);
    case Op::greater: return decided(arb_gt(x, y) != 0, arb_le(x, y) != 0);
    case Op::greater_equal: return decided(arb_ge(x, y) != 0, arb_lt(x, y) != 0);
    case Op::equal: return decided(arb_eq(x, y) != 0, arb_ne(x, y) != 0);
    default: return decided(arb_ne(x, y) != 0, arb_eq(x, y) != 0);
    }
}

Ball unary(Op op, const Ball& a, slong precision)
{
    Ball result;
    arb_ptr z = result.get();
    arb_srcptr x = a.get();
    switch (op) {
    case Op::negate: arb_neg(z, x); break;
    case Op::sqrt: arb_sqrt(z, x, precision); break;
    case Op::sin: arb_sin(z, x, precision); break;
    case Op::cos: arb_cos(z, x, precision); break;
    case Op::tan: arb_tan(z, x, precision); break;
    case Op::asin: arb_asin(z, x, precision); break;
    case Op::acos: arb_acos(z, x, precision); break;
    case Op::atan: arb_atan(z, x, precision); break;
    case Op::sinh: arb_sinh(z, x, precision); break;
    case Op::cosh: arb_cosh(z, x, precision); break;
    case Op::tanh: arb_tanh(z, x, precision); break;
    case Op::exp: arb_exp(z, x, precision); break;
    case Op::log: arb_log(z, x, precision); break;
    case Op::abs: arb_abs(z, x); break;
    case Op::sign: arb_sgn(z, x); break;
    default: arb_indeterminate(z); break;
    }
    return result;
}

/// A constant exponent: x >= 0, x > 0 where it is negative, any x where it is an integer. Any other exponent: x > 0,
/// also where it happens to be an integer at the point, so that x^y is defined on open sets only and equals exp(y log
/// x).
void real_power(arb_ptr z, arb_srcptr x, arb_srcptr y, bool constant, slong precision)
{
    if (constant && arb_is_zero(x) != 0 && arb_is_positive(y) != 0) {
        arb_zero(z);
    } else if (arb_is_positive(x) != 0 || (constant && arb_is_int(y) != 0)) {
        arb_pow(z, x, y, precision);
    } else {
        arb_indeterminate(z);
    }
}

} // namespace

Ball::Ball(const Rational& value, slong precision) : Ball()
{
    fmpq_t q;
    fmpq_init(q);
    fmpq_set_mpq(q, value.get_mpq_t());
    arb_set_fmpq(ball_, q, precision);
    fmpq_clear(q);
}

double Ball::bound() const
{
    if (!is_finite()) return std::numeric_limits<double>::infinity();
    mag_t magnitude;
    mag_init(magnitude);
    arb_get_mag(magnitude, ball_);
    const double value = mag_get_d(magnitude);
    mag_clear(magnitude);
    return value;
}

double Ball::middle() const
{
    return arf_get_d(arb_midref(ball_), ARF_RND_NEAR);
}

Evaluation::Evaluation(const Graph& graph, std::vector<NodeId> roots)
    : graph_(graph), roots_(std::move(roots)), order_(reachable(graph, roots_))
{
    for (std::size_t k = 0; k < order_.size(); ++k) {
        slots_[order_[k]] = k;
        if (graph.op(order_[k]) == Op::input) inputs_.push_back(order_[k]);
    }
}

std::vector<Ball> Evaluation::enclose(const BallInputs& inputs, slong precision) const
{
    std::vector<Ball> values(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const NodeId node = order_[k];
        values[k] = graph_.op(node) == Op::input ? inputs.at(node) : enclose_node(node, values, precision);
    }
    std::vector<Ball> results;
    for (const NodeId root : roots_) results.push_back(values[slots_.at(root)]);
    return results;
}

Ball Evaluation::enclose_node(NodeId node, const std::vector<Ball>& values, slong precision) const
{
    const Op op = graph_.op(node);
    Ball result;
    arb_ptr z = result.get();
    if (op == Op::constant) return {graph_.value(node), precision};
    if (op == Op::pi) {
        arb_const_pi(z, precision);
        return result;
    }
    if (op == Op::component) return enclose_component(node, values, precision);
    if (op == Op::factor || op == Op::solve) return result;
    const Ball& a = operand(node, 0, values);
    if (op == Op::power) {
        const auto exponent = static_cast<std::int32_t>(graph_.payload(node));
        fmpz_t e;
        fmpz_init(e);
        fmpz_set_si(e, exponent);
        arb_pow_fmpz(z, a.get(), e, precision);
        fmpz_clear(e);
        return result;
    }
    if (op == Op::stumpff) return enclose_stumpff(graph_.payload(node), a, precision);
    if (graph_.operands(node).size() == 1) return unary(op, a, precision);
    const Ball& b = operand(node, 1, values);
    switch (op) {
    case Op::add: arb_add(z, a.get(), b.get(), precision); break;
    case Op::subtract: arb_sub(z, a.get(), b.get(), precision); break;
    case Op::multiply: arb_mul(z, a.get(), b.get(), precision); break;
    case Op::divide: arb_div(z, a.get(), b.get(), precision); break;
    case Op::real_power:
        real_power(z, a.get(), b.get(), graph_.is_constant(graph_.operands(node)[1]), precision);
        break;
    case Op::atan2: // undefined at the origin
        if (arb_contains_zero(a.get()) != 0 && arb_contains_zero(b.get()) != 0) {
            arb_indeterminate(z);
        } else {
            arb_atan2(z, a.get(), b.get(), precision);
        }
        break;
    case Op::minimum: arb_min(z, a.get(), b.get(), precision); break;
    case Op::maximum: arb_max(z, a.get(), b.get(), precision); break;
    case Op::select:
        if (a.excludes_zero()) return b;
        if (arb_is_zero(a.get()) != 0) return operand(node, 2, values);
        arb_indeterminate(z);
        break;
    default: return compare(op, a, b);
    }
    return result;
}

Ball Evaluation::enclose_component(NodeId node, const std::vector<Ball>& values, slong precision) const
{
    const NodeId solve = graph_.operands(node)[0];
    const auto operands = graph_.operands(solve);
    const auto entries = graph_.operands(operands[0]);
    const auto n = static_cast<slong>(operands.size() - 1);
    arb_mat_t matrix, right, solution;
    arb_mat_init(matrix, n, n);
    arb_mat_init(right, n, 1);
    arb_mat_init(solution, n, 1);
    for (slong i = 0; i < n; ++i) {
        arb_set(arb_mat_entry(right, i, 0), values[slots_.at(operands[static_cast<std::size_t>(i) + 1])].get());
        for (slong j = 0; j < n; ++j)
            arb_set(arb_mat_entry(matrix, i, j), values[slots_.at(entries[static_cast<std::size_t>(i * n + j)])].get());
    }
    Ball result;
    if (arb_mat_solve(solution, matrix, right, precision) != 0) {
        arb_set(result.get(), arb_mat_entry(solution, static_cast<slong>(graph_.payload(node)), 0));
    } else {
        arb_indeterminate(result.get());
    }
    arb_mat_clear(matrix);
    arb_mat_clear(right);
    arb_mat_clear(solution);
    return result;
}

} // namespace lagen::proof
