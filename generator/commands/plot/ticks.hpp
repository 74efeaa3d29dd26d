// SPDX-License-Identifier: GPL-2.0-or-later
/// Round numbers for an axis.
#pragma once

#include <vector>

namespace lagen {

/// The multiples in [low, high] of 1, 2 or 5 times a power of ten, about four of them.
[[nodiscard]] std::vector<double> round_ticks(double low, double high);

} // namespace lagen
