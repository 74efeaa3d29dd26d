// SPDX-License-Identifier: GPL-2.0-or-later
/// Where a run starts, in the lanes of the generated state.
#pragma once

#include "pipeline.hpp"
#include "scene/evaluate_scene.hpp"

#include <functional>

namespace lagen {

/// Base lanes, then the other lanes of `form`. Lagrange's form with momenta given: y solves p_a(x, y) =
/// mu_a. Hamilton's with fibre coordinates given: mu = dL/dy, or mu solves dH/dmu_a = y^a. By Newton's method from 0,
/// in long double; throws MathematicsError where it does not converge. `checked` is called where the values given are
/// not the lanes themselves.
[[nodiscard]] std::vector<long double> start_state(const std::function<const CheckedModel&()>& checked,
                                                   const std::string& form, const SceneValues& values);

/// The numbers in the order of `named`. Throws ModelError where a double, as the compiled scene has it, cannot hold
/// one.
[[nodiscard]] std::vector<long double> finite_numbers(const std::vector<NamedNumber>& named, const Scene& scene);

} // namespace lagen
