// SPDX-License-Identifier: GPL-2.0-or-later
/// Ball arithmetic, node by node. Arb answers "not finite" for every argument outside a function's domain, and so it
/// spreads to all that depends on it.
#include "proof/enclosure.hpp"

#include "expression/evaluate_stumpff.hpp"
#include "graph/core/operators.hpp"

#include <arb_hypgeom.h>
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

/// By the signs that a - b may have.
Ball compare(const Trichotomy& holds, const Ball& a, const Ball& b)
{
    if (!a.is_finite() || !b.is_finite()) return decided(false, false);
    const bool below = arb_ge(a.get(), b.get()) == 0;
    const bool equal = arb_ne(a.get(), b.get()) == 0;
    const bool above = arb_le(a.get(), b.get()) == 0;
    const bool yes = (below && holds.below) || (equal && holds.equal) || (above && holds.above);
    const bool no = (below && !holds.below) || (equal && !holds.equal) || (above && !holds.above);
    return decided(yes && !no, no && !yes);
}

/// a where the condition is not 0, b where it is.
Ball chosen(const Ball& condition, const Ball& a, const Ball& b)
{
    if (condition.excludes_zero()) return a;
    return arb_is_zero(condition.get()) != 0 ? b : decided(false, false);
}

/// Undefined at the origin.
void angle(arb_ptr z, arb_srcptr y, arb_srcptr x, slong precision)
{
    if (arb_contains_zero(y) != 0 && arb_contains_zero(x) != 0)
        arb_indeterminate(z);
    else
        arb_atan2(z, y, x, precision);
}

void integer_power(arb_ptr z, arb_srcptr x, std::int32_t exponent, slong precision)
{
    fmpz_t e;
    fmpz_init(e);
    fmpz_set_si(e, exponent);
    arb_pow_fmpz(z, x, e, precision);
    fmpz_clear(e);
}

/// [0, b], where b bounds |x|.
void set_up_to(arb_ptr z, arb_srcptr x)
{
    mag_t half;
    mag_init(half);
    arb_get_mag(half, x);
    mag_mul_2exp_si(half, half, -1);
    arf_set_mag(arb_midref(z), half);
    mag_swap(arb_radref(z), half);
    mag_clear(half);
}

/// What is left of an enclosure of something that is not below 0.
void cut_below_zero(Ball& x)
{
    if (x.is_finite() && arb_contains_negative(x.get()) != 0) set_up_to(x.get(), x.get());
}

/// A constant exponent: x >= 0, x > 0 where it is negative, any x where it is an integer. Any other exponent: x > 0,
/// also where it happens to be an integer at the point, so that x^y is defined on open sets only and equals exp(y log
/// x).
void real_power(arb_ptr z, arb_srcptr x, arb_srcptr y, bool constant, slong precision)
{
    if (constant && arb_is_zero(x) != 0 && arb_is_positive(y) != 0) {
        arb_zero(z);
    } else if (constant && arb_is_nonnegative(x) != 0 && arb_contains_zero(x) != 0 && arb_is_positive(y) != 0) {
        arb_t end;
        arb_init(end);
        arb_get_ubound_arf(arb_midref(end), x, precision);
        arb_pow(end, end, y, precision);
        set_up_to(z, end);
        arb_clear(end);
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
        nonnegative_.push_back(is_nonnegative(order_[k]));
    }
}

bool Evaluation::is_nonnegative(NodeId node) const
{
    const auto operands = graph_.operands(node);
    const auto known = [&](std::size_t k) { return nonnegative_[slots_.at(operands[k])]; };
    switch (graph_.op(node)) {
    case Op::constant: return sgn(graph_.value(node)) >= 0;
    case Op::pi:
    case Op::abs:
    case Op::sqrt:
    case Op::exp:
    case Op::cosh: return true;
    case Op::power: return graph_.payload(node) % 2 == 0 || known(0);
    case Op::real_power:
        return known(0) || !graph_.is_constant(operands[1]) || graph_.value(operands[1]).get_den() != 1;
    case Op::multiply: return operands[0] == operands[1] || (known(0) && known(1));
    case Op::maximum: return known(0) || known(1);
    case Op::add:
    case Op::divide:
    case Op::minimum: return known(0) && known(1);
    case Op::select: return known(1) && known(2);
    default: return false;
    }
}

std::vector<Ball> Evaluation::enclose(const BallInputs& inputs, slong precision) const
{
    std::vector<Ball> values(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const NodeId node = order_[k];
        values[k] = graph_.op(node) == Op::input ? inputs.at(node) : enclose_node(node, values, precision);
        if (nonnegative_[k]) cut_below_zero(values[k]);
    }
    std::vector<Ball> results;
    for (const NodeId root : roots_) results.push_back(values[slots_.at(root)]);
    return results;
}

Ball Evaluation::enclose_node(NodeId node, const std::vector<Ball>& values, slong precision) const
{
    const auto operands = graph_.operands(node);
    const auto at = [&](std::size_t k) -> const Ball& { return operand(node, k, values); };
    Ball result;
    arb_ptr z = result.get();
    arb_srcptr x = operands.empty() ? nullptr : at(0).get();
    arb_srcptr y = operands.size() < 2 ? nullptr : at(1).get();
    switch (graph_.op(node)) {
    case Op::constant: return {graph_.value(node), precision};
    case Op::pi: arb_const_pi(z, precision); break;
    case Op::add: arb_add(z, x, y, precision); break;
    case Op::subtract: arb_sub(z, x, y, precision); break;
    case Op::multiply: arb_mul(z, x, y, precision); break;
    case Op::divide: arb_div(z, x, y, precision); break;
    case Op::negate: arb_neg(z, x); break;
    case Op::power: integer_power(z, x, static_cast<std::int32_t>(graph_.payload(node)), precision); break;
    case Op::real_power: real_power(z, x, y, graph_.is_constant(operands[1]), precision); break;
    case Op::sqrt: arb_sqrt(z, x, precision); break;
    case Op::sin: arb_sin(z, x, precision); break;
    case Op::cos: arb_cos(z, x, precision); break;
    case Op::tan: arb_tan(z, x, precision); break;
    case Op::asin: arb_asin(z, x, precision); break;
    case Op::acos: arb_acos(z, x, precision); break;
    case Op::atan: arb_atan(z, x, precision); break;
    case Op::atan2: angle(z, x, y, precision); break;
    case Op::sinh: arb_sinh(z, x, precision); break;
    case Op::cosh: arb_cosh(z, x, precision); break;
    case Op::tanh: arb_tanh(z, x, precision); break;
    case Op::exp: arb_exp(z, x, precision); break;
    case Op::log: arb_log(z, x, precision); break;
    case Op::abs: arb_abs(z, x); break;
    case Op::minimum: arb_min(z, x, y, precision); break;
    case Op::maximum: arb_max(z, x, y, precision); break;
    case Op::sign: arb_sgn(z, x); break;
    case Op::stumpff: return enclose_stumpff(graph_.payload(node), at(0), precision);
    case Op::erf: arb_hypgeom_erf(z, x, precision); break;
    case Op::less:
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
    case Op::equal:
    case Op::not_equal: return compare(operator_of(graph_.op(node)).holds, at(0), at(1));
    case Op::select: return chosen(at(0), at(1), at(2));
    case Op::input: // given
    case Op::factor:
    case Op::solve: break; // read by the components
    case Op::component: return enclose_component(node, values, precision);
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

// Exact rational evaluation, as far as every operation is rational at the point.

namespace {

constexpr std::size_t longest_number = 20'000; ///< bits

} // namespace

std::optional<std::vector<Rational>> Evaluation::exactly(const ExactInputs& inputs) const
{
    std::vector<Rational> values(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const NodeId node = order_[k];
        if (graph_.op(node) == Op::input) {
            const auto at = inputs.find(node);
            if (at == inputs.end()) return std::nullopt;
            values[k] = at->second;
        } else if (!exact_node(node, values, values[k]) || bits_of(values[k]) > longest_number) {
            return std::nullopt;
        }
    }
    std::vector<Rational> results;
    for (const NodeId root : roots_) results.push_back(values[slots_.at(root)]);
    return results;
}

bool Evaluation::exact_node(NodeId node, const std::vector<Rational>& values, Rational& result) const
{
    if (graph_.is_constant(node)) {
        result = graph_.value(node);
        return true;
    }
    const OpKind kind = kind_of(graph_.op(node));
    if (kind == OpKind::leaf || kind == OpKind::system) return false;
    const auto operands = graph_.operands(node);
    Rational x[3];
    for (std::size_t k = 0; k < operands.size(); ++k) x[k] = operand(node, k, values);
    const auto exact = exact_value(graph_.op(node), x, graph_.payload(node), 4 * longest_number);
    if (exact) result = *exact;
    return exact.has_value();
}

// Enclosures of c_k(z) = sum_j (-z)^j / (2j+k)!: the series with a bound of its tail, closed forms for a large |z|.

namespace {

constexpr slong series_bits = 16; ///< |z| < 2^16: the terms rise to exp(256) at most

/// Sums until a term is below 2^-precision of 1/k!; from there on every term is at most half of the one before it, so
/// that the tail is at most twice the first term left out.
void sum_series(arb_ptr sum, unsigned k, arb_srcptr z, slong precision)
{
    Ball term(stumpff_at_zero(k), precision);
    mag_t size, last, ratio, divisor;
    mag_init(size);
    mag_init(last);
    mag_init(ratio);
    mag_init(divisor);
    arb_get_mag(last, term.get());
    mag_mul_2exp_si(last, last, -precision);
    arb_zero(sum);
    for (unsigned long n = k;; n += 2) {
        arb_get_mag(size, term.get());
        arb_get_mag(ratio, z);
        mag_set_ui_lower(divisor, (n + 1) * (n + 2));
        mag_div(ratio, ratio, divisor);
        if (mag_cmp(size, last) <= 0 && mag_cmp_2exp_si(ratio, -1) <= 0) break;
        arb_add(sum, sum, term.get(), precision);
        arb_mul(term.get(), term.get(), z, precision);
        arb_div_ui(term.get(), term.get(), (n + 1) * (n + 2), precision);
        arb_neg(term.get(), term.get());
    }
    mag_mul_2exp_si(size, size, 1);
    arb_add_error_mag(sum, size);
    mag_clear(size);
    mag_clear(last);
    mag_clear(ratio);
    mag_clear(divisor);
}

/// From c_0 or c_1 by z c_{k+2} = 1/k! - c_k.
void climb(arb_ptr value, unsigned k, arb_srcptr z, slong precision)
{
    Ball root;
    const bool odd = k % 2 != 0;
    arb_abs(root.get(), z);
    arb_sqrt(root.get(), root.get(), precision);
    if (arb_is_positive(z) != 0)
        odd ? arb_sin(value, root.get(), precision) : arb_cos(value, root.get(), precision);
    else
        odd ? arb_sinh(value, root.get(), precision) : arb_cosh(value, root.get(), precision);
    if (odd) arb_div(value, value, root.get(), precision);
    for (unsigned j = k % 2; j < k; j += 2) {
        arb_sub(value, Ball(stumpff_at_zero(j), precision).get(), value, precision);
        arb_div(value, value, z, precision);
    }
}

} // namespace

Ball enclose_stumpff(unsigned k, const Ball& z, slong precision)
{
    Ball result;
    mag_t size;
    mag_init(size);
    arb_get_mag(size, z.get());
    const bool small = z.is_finite() && mag_cmp_2exp_si(size, series_bits) < 0;
    if (small) {
        // The largest term is exp(sqrt|z|) times the first, the sum may be smaller than it by |z|.
        const double root = std::sqrt(mag_get_d(size));
        sum_series(result.get(), k, z.get(), precision + static_cast<slong>(1.5 * root) + 2 * series_bits);
    } else if (z.is_finite() && z.excludes_zero()) {
        climb(result.get(), k, z.get(), precision + 2 * series_bits);
    } else {
        arb_indeterminate(result.get());
    }
    mag_clear(size);
    return result;
}

} // namespace lagen::proof
