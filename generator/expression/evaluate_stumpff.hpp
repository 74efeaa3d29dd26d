// SPDX-License-Identifier: GPL-2.0-or-later
/// Values of the Stumpff functions c_k(z) = sum_j (-z)^j / (2j+k)!, the reference for every other way to compute them.
#pragma once

#include "expression/tree.hpp"

namespace lagen {

/// The highest order that a graph may hold; the language allows 0 .. 32, a derivative raises the order by two.
inline constexpr unsigned largest_stumpff_order = 64;

/// c_k(0) = 1/k!.
[[nodiscard]] Rational stumpff_at_zero(unsigned k);

/// c_k(z) rounded to Scalar from a multiprecision value of at least 64 more bits. Infinite where it overflows; not a
/// number where z is none or is infinite. Instantiated for float, double, long double.
template <class Scalar>
[[nodiscard]] Scalar evaluate_stumpff(unsigned k, Scalar z);

} // namespace lagen
