// SPDX-License-Identifier: GPL-2.0-or-later
/// The series for |z| < 1; beyond, c_0 and c_1 in closed form and the recurrence z c_{k+2} = 1/k! - c_k upwards.
#include "expression/evaluate_stumpff.hpp"

#include <mpfr.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace lagen {
namespace {

/// One multiprecision number with an owner.
class Real {
  public:
    explicit Real(mpfr_prec_t precision) { mpfr_init2(value_, precision); }
    ~Real() { mpfr_clear(value_); }
    Real(const Real&) = delete;
    Real& operator=(const Real&) = delete;
    [[nodiscard]] mpfr_ptr get() { return value_; }

  private:
    mpfr_t value_;
};

/// Terms fall by |z| / ((2j+k+1)(2j+k+2)) < 1/2 each; they end below 2^-precision of the first.
void sum_series(mpfr_ptr sum, unsigned k, mpfr_srcptr z)
{
    const mpfr_prec_t precision = mpfr_get_prec(sum);
    Real term(precision);
    mpfr_set_q(sum, stumpff_at_zero(k).get_mpq_t(), MPFR_RNDN);
    mpfr_set(term.get(), sum, MPFR_RNDN);
    const mpfr_exp_t last = mpfr_get_exp(sum) - static_cast<mpfr_exp_t>(precision);
    for (unsigned long n = k; mpfr_zero_p(term.get()) == 0 && mpfr_get_exp(term.get()) >= last; n += 2) {
        mpfr_mul(term.get(), term.get(), z, MPFR_RNDN);
        mpfr_div_ui(term.get(), term.get(), (n + 1) * (n + 2), MPFR_RNDN);
        mpfr_neg(term.get(), term.get(), MPFR_RNDN);
        mpfr_add(sum, sum, term.get(), MPFR_RNDN);
    }
}

/// From c_0 = cos sqrt z or c_1 = sin(sqrt z)/sqrt z (hyperbolic for z < 0).
void climb(mpfr_ptr value, unsigned k, mpfr_srcptr z)
{
    const mpfr_prec_t precision = mpfr_get_prec(value);
    Real root(precision);
    mpfr_abs(root.get(), z, MPFR_RNDN);
    mpfr_sqrt(root.get(), root.get(), MPFR_RNDN);
    const bool odd = k % 2 != 0;
    if (mpfr_sgn(z) > 0)
        odd ? mpfr_sin(value, root.get(), MPFR_RNDN) : mpfr_cos(value, root.get(), MPFR_RNDN);
    else
        odd ? mpfr_sinh(value, root.get(), MPFR_RNDN) : mpfr_cosh(value, root.get(), MPFR_RNDN);
    if (odd) mpfr_div(value, value, root.get(), MPFR_RNDN);
    for (unsigned j = k % 2; j < k; j += 2) {
        mpfr_sub_q(value, value, stumpff_at_zero(j).get_mpq_t(), MPFR_RNDN);
        mpfr_div(value, value, z, MPFR_RNDN);
        mpfr_neg(value, value, MPFR_RNDN);
    }
}

} // namespace

Rational stumpff_at_zero(unsigned k)
{
    Rational value(1);
    mpz_fac_ui(value.get_den_mpz_t(), k);
    return value;
}

template <class Scalar>
Scalar evaluate_stumpff(unsigned k, Scalar z)
{
    if (!std::isfinite(z)) return std::numeric_limits<Scalar>::quiet_NaN();
    // Each step upwards loses (k+1)(k+2)/z of the digits, together less than k! (296 bits for k = 64); a large z loses
    // the bits of sqrt(z).
    const int exponent = z == 0 ? 0 : std::ilogb(z);
    const mpfr_prec_t precision =
        192 + (exponent > 0 ? exponent / 2 : 0) + (exponent >= 0 ? 5 * static_cast<int>(k) : 0);
    Real argument(64);
    Real value(precision);
    mpfr_set_ld(argument.get(), static_cast<long double>(z), MPFR_RNDN);
    if (exponent < 0)
        sum_series(value.get(), k, argument.get());
    else if (z == 0)
        mpfr_set_q(value.get(), stumpff_at_zero(k).get_mpq_t(), MPFR_RNDN);
    else
        climb(value.get(), k, argument.get());
    if constexpr (std::is_same_v<Scalar, float>)
        return mpfr_get_flt(value.get(), MPFR_RNDN);
    else if constexpr (std::is_same_v<Scalar, double>)
        return mpfr_get_d(value.get(), MPFR_RNDN);
    else
        return mpfr_get_ld(value.get(), MPFR_RNDN);
}

template float evaluate_stumpff(unsigned, float);
template double evaluate_stumpff(unsigned, double);
template long double evaluate_stumpff(unsigned, long double);

} // namespace lagen
