// SPDX-License-Identifier: GPL-2.0-or-later
/// The scene of the target that starts where a morphism puts the start of a scene of the source.
#pragma once

#include "commands/morphism/projection.hpp"
#include "commands/scene/scene_run.hpp"

namespace lagen {

/// Lets the scene, which has its form, observe all states and targets of arrows behind what it observes anyway; the
/// number of columns that were asked for.
[[nodiscard]] std::size_t observe_states(const Model& model, Scene& scene);

/// Times of `rows`, and method, step and tolerances of the run of the source. Gives the projection the parameters of
/// the target. Throws MathematicsError where the target has no equations of this form, and where momenta of the source
/// are not those of one start of the target.
[[nodiscard]] Scene image_scene(const SceneRun& source, const Table& rows, const Model& target, Projection& projection);

} // namespace lagen
