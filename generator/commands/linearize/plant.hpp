// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of motion of a scene with numbers for its parameters, over the state and the inputs, and where the
/// scene starts.
#pragma once

#include "analysis/equilibrium.hpp"
#include "pipeline.hpp"
#include "scene/evaluate_scene.hpp"

namespace lagen {

struct Plant {
    Graph graph;
    MotionEquations equations;
    std::vector<MotionPoint> starts; ///< that of the scene, and the same without velocities or momenta
    std::vector<NamedNumber> parameters;
    std::vector<std::string>
        following; ///< matrices of [reconstruct], which are no states here: nothing depends on them
};

/// Throws MathematicsError: a form without rates of x and y, explicit time, a matrix of [reconstruct] that acts on the
/// motion, an input that is no finite number.
[[nodiscard]] Plant plant_of(CheckedModel& checked, const Scene& scene);

} // namespace lagen
