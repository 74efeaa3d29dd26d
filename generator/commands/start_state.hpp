// SPDX-License-Identifier: GPL-2.0-or-later
/// Where a run starts, in the lanes of the generated state.
#pragma once

#include "pipeline.hpp"
#include "scene/evaluate_scene.hpp"

namespace lagen {

/// Base lanes, then the other lanes of the module's form. Lagrange's form with momenta given: y solves p_a(x, y) =
/// mu_a. Hamilton's with fibre coordinates given: mu = dL/dy, or mu solves dH/dmu_a = y^a. By Newton's method from 0,
/// in long double; throws MathematicsError where it does not converge.
[[nodiscard]] std::vector<long double> start_state(const CheckedModel& checked, const KernelModule& module,
                                                   const SceneValues& values);

} // namespace lagen
