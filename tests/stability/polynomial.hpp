// SPDX-License-Identifier: GPL-2.0-or-later
/// Polynomials with exact rational coefficients, and where they become negative.
#pragma once

#include <gmpxx.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lagen::stability {

/// By rising powers.
using Polynomial = std::vector<mpq_class>;

[[nodiscard]] Polynomial operator+(const Polynomial& p, const Polynomial& q);
[[nodiscard]] Polynomial operator-(const Polynomial& p, const Polynomial& q);
[[nodiscard]] Polynomial operator*(const Polynomial& p, const Polynomial& q);
[[nodiscard]] Polynomial operator*(const mpq_class& factor, Polynomial p);

/// p(x^2).
[[nodiscard]] Polynomial in_squares(const Polynomial& p);
/// p(-x).
[[nodiscard]] Polynomial reflected(Polynomial p);
/// Re p(i y) and Im p(i y) / y as polynomials in y^2.
[[nodiscard]] Polynomial real_on_axis(const Polynomial& p);
[[nodiscard]] Polynomial imaginary_on_axis(const Polynomial& p);

/// The largest a so that p >= 0 on all of [0, a], in double; nothing where p is never negative. The first `zeros`
/// coefficients are 0 by the order conditions of a method and count as that, whatever its published digits make of
/// them. Intervals in which p is negative are found down to a width of 1/64, narrower ones by their least value.
[[nodiscard]] std::optional<double> first_negative(const Polynomial& p, std::size_t zeros = 0);

/// Whether all zeros of p have positive real parts [Routh 1877].
[[nodiscard]] bool has_zeros_on_the_right(const Polynomial& p);

} // namespace lagen::stability
