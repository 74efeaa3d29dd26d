// SPDX-License-Identifier: GPL-2.0-or-later
/// Levenberg and Marquardt's steps towards a zero of equations F(z) = 0, as many as there are, in floating point:
///   (J^T J + damping) dz = -J^T F,      a damping that falls with |F|.
/// Where the zeros make families the steps end at one near the start, and an unknown that no equation depends on stays
/// where it is. [Yamashita and Fukushima 2001]
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace lagen::proof {

/// F at a point.
struct Residual {
    std::vector<double> values; ///< F
    std::vector<double> slopes; ///< dF/dz by rows
    double size = 0;            ///< of the terms of F: less than 1e-13 of it is rounding

    [[nodiscard]] double length() const;
};

/// Where the steps end: at rounding, or where none of them makes |F| smaller.
struct LeastSquares {
    std::vector<double> z;
    Residual at;
};

/// Where a step takes z, on a set that is no vector space; the slopes are by the step then.
using Move = std::function<std::vector<double>(const std::vector<double>& z, const std::vector<double>& step)>;

/// Nothing where F is no finite number on the way. Without `move` steps are added.
[[nodiscard]] std::optional<LeastSquares>
least_squares(std::vector<double> z, const std::function<Residual(const std::vector<double>&)>& residual,
              const Move& move = {});

} // namespace lagen::proof
