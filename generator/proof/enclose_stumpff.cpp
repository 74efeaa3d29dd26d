// SPDX-License-Identifier: GPL-2.0-or-later
/// Enclosures of c_k(z) = sum_j (-z)^j / (2j+k)!: the series with a bound of its tail, closed forms for a large |z|.
#include "proof/enclosure.hpp"

#include "expression/evaluate_stumpff.hpp"

#include <cmath>

namespace lagen::proof {

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
