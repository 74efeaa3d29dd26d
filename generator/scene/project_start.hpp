// SPDX-License-Identifier: GPL-2.0-or-later
/// How far a start misses the base constraints, and the nearest way onto them.
#pragma once

#include "graph/core/graph.hpp"
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

/// The constraints and the Casimirs of a model with their gradients, on a graph of their own.
class ConstraintFunctions {
  public:
    explicit ConstraintFunctions(const Model& model);

    /// One value a constraint. `values` binds parameters and base coordinates.
    [[nodiscard]] std::vector<ConstraintValue> at(const Values& values) const;
    [[nodiscard]] std::vector<ConstraintValue> casimirs_at(const Values& values) const;
    /// Names of the base coordinates, in their order.
    [[nodiscard]] const std::vector<std::string>& coordinates() const { return coordinates_; }

  private:
    using Functions = std::vector<std::vector<NodeId>>; ///< of each: its value, its gradient, its terms
    [[nodiscard]] std::vector<ConstraintValue> at(const Functions& functions, const Values& values) const;

    Graph graph_;
    std::vector<std::string> coordinates_;
    Functions constraints_, casimirs_;
};

/// Moves the base coordinates of `values` onto the constraints by Newton steps of least Euclidean length, on the levels
/// of the Casimirs, declared or found, that are no functions of the constraints; true where they were reached, to 1e-17
/// of their scale or as near as rounding lets them come.
[[nodiscard]] bool project_start(const ConstraintFunctions& constraints, Values& values);

} // namespace lagen
