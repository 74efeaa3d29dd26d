// SPDX-License-Identifier: GPL-2.0-or-later
/// The jumps of events as maps of the state.
#pragma once

#include "kernels/formulation.hpp"

namespace lagen {

/// True where an event of `scene`, or of any scene where it is null, has a jump that can be made in the form.
[[nodiscard]] bool has_jumps(const Model& model, const Scene* scene, const EquationForm& form);

/// The kernel `jumps` of them: a column each with the lanes of the state behind it, functions of the state before it;
/// the same jump of two scenes once, different ones of one name with the scene's name in front. What a jump does not
/// set stays: base coordinates, first-order states, and fibre coordinates, or momenta where it sets some. In Hamilton's
/// form fibre coordinates give momenta by mu_a = dL/dy^a at the x and y behind the jump.
[[nodiscard]] Kernel jumps_kernel(Graph& graph, const Model& model, const System& system, const Formulation& form,
                                  const Scene* scene);

} // namespace lagen
