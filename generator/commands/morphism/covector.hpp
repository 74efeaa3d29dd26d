// SPDX-License-Identifier: GPL-2.0-or-later
/// Covectors along a linear map.
#pragma once

#include <vector>

namespace lagen {

/// mu' with Phi^a_b mu'_a = mu_b, by Gauss's elimination with the largest pivots; `matrix`: Phi^a_b by rows, one row a
/// component of mu'. Throws MathematicsError where no mu' has this image, to 1e-10 of the largest |mu_b|, and where
/// more than one has.
[[nodiscard]] std::vector<long double> pushed_covector(const std::vector<long double>& matrix,
                                                       const std::vector<long double>& mu);

} // namespace lagen
