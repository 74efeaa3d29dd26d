// SPDX-License-Identifier: GPL-2.0-or-later
/// Zeros in disguise: expressions that vanish wherever they are defined, and their near misses, which vanish for one
/// sign of a root only.
#pragma once

#include "local_algebroid.hpp"

namespace lagen::laws {

/// Zero on the whole real line (in the coordinates x, y, which may be the same).
[[nodiscard]] std::vector<Formula> hidden_zeros(const Formula& x, const Formula& y);

/// Zero where x > 0 and y > 0.
[[nodiscard]] std::vector<Formula> hidden_zeros_of_positive(const Formula& x, const Formula& y);

/// Each vanishes on an open set and not everywhere where it is defined.
[[nodiscard]] std::vector<Formula> half_zeros(const Formula& x, const Formula& y);

/// Up to three entries of rho and C gain a multiple of a hidden zero; of the positive ones where the domain makes the
/// first two coordinates positive.
[[nodiscard]] LocalAlgebroid disguised(const LocalAlgebroid& algebroid, bool positive, Dice& dice);

} // namespace lagen::laws
