// SPDX-License-Identifier: GPL-2.0-or-later
/// The truth about an algebroid, from its definition: residuals of the structure equations at points, by jets.
#pragma once

#include "jet.hpp"
#include "local_algebroid.hpp"

#include <optional>

namespace lagen::laws {

/// `indices` are names in the order of the report: (a, b, c), (a, b, i), (a, b, c, v), (a, h).
struct PointResidual {
    std::string name; ///< antisymmetry, anchor, jacobi, tangency
    std::vector<std::string> indices;
    Ball value;
};

/// Every residual at a point; nothing where an entry of rho, C or a constraint is undefined there.
[[nodiscard]] std::optional<std::vector<PointResidual>> residuals_at(const LocalAlgebroid& algebroid,
                                                                     const Point& point);

/// A random point of the constraint set, inside the domain, parameters random; nothing where none was found.
[[nodiscard]] std::optional<Point> random_point(const LocalAlgebroid& algebroid, Dice& dice);

enum class Truth {
    violated, ///< certainly: at one point a residual's ball excludes zero
    holds,    ///< every residual is below 1e-60 at all points
    unknown   ///< no point, or balls too wide
};

/// Looks at `points` regular points.
[[nodiscard]] Truth truth_of(const LocalAlgebroid& algebroid, Dice& dice, std::size_t points);

} // namespace lagen::laws
