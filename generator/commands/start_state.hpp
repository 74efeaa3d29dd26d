// SPDX-License-Identifier: GPL-2.0-or-later
/// Where a run starts, in the lanes of the generated state.
#pragma once

#include "graph/kernel.hpp"
#include "model/evaluate_scene.hpp"

namespace lagen {

/// Base lanes, then fibre lanes. Where the scene gives momenta instead of fibre coordinates, y solves p_a(x, y) = mu_a
/// by Newton's method on the module's kernels `momentum` and `mass_matrix`, from y = 0, in long double; throws
/// MathematicsError where it does not converge.
[[nodiscard]] std::vector<long double> start_state(const KernelModule& module, const SceneValues& values);

} // namespace lagen
