// SPDX-License-Identifier: GPL-2.0-or-later
/// Fractions behind floating-point numbers.
#pragma once

#include "expression/tree.hpp"

#include <optional>

namespace lagen {

/// The fraction with the smallest denominator that is this number to within `tolerance` of max(1, |x|); nothing where
/// the denominator is above 100000.
[[nodiscard]] std::optional<Rational> rational_near(long double x, long double tolerance);

} // namespace lagen
