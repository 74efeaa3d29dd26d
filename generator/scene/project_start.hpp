// SPDX-License-Identifier: GPL-2.0-or-later
/// How far a start misses the base constraints, and the nearest way onto them.
#pragma once

#include "model/model.hpp"
#include "scene/values.hpp"

#include <cmath>
#include <vector>

namespace lagen {

/// h at the start, its gradient in the base coordinates, and the magnitude against which |h| is small.
struct ConstraintValue {
    long double value = 0;
    long double scale = 0; ///< max(sum |terms of h|, sum_i |x^i dh/dx^i|)
    std::vector<long double> gradient;

    [[nodiscard]] bool holds(long double tolerance) const
    {
        return !(std::abs(value) > tolerance * scale) && value == value;
    }
};

/// One value a constraint. `values` binds parameters and base coordinates.
[[nodiscard]] std::vector<ConstraintValue> constraint_values(const Model& model, const Values& values);

/// Moves the base coordinates of `values` onto the constraints by Newton steps of least Euclidean length; true where
/// they were reached, to 1e-17 of their scale or as near as rounding lets them come.
[[nodiscard]] bool project_start(const Model& model, Values& values);

} // namespace lagen
