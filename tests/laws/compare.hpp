// SPDX-License-Identifier: GPL-2.0-or-later
/// Whether rho and C that lagen builds for a kind are those of the formulas.
#pragma once

#include "mechanics/written_algebroid.hpp"
#include "oracle.hpp"

namespace lagen::laws {

/// The first entry of rho or C that differs at a random point, or empty. Sections are matched by position.
[[nodiscard]] std::string difference_from(const WrittenAlgebroid& built, const LocalAlgebroid& expected, Dice& dice);

} // namespace lagen::laws
