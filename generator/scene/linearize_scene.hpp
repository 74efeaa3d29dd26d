// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of motion of a scene with numbers for its parameters, linearised at an equilibrium near its start.
#pragma once

#include "analysis/equilibrium.hpp"
#include "linear/linear_system.hpp"
#include "linear/regulator.hpp"
#include "pipeline.hpp"

namespace lagen {

/// A weight over parameters, and where it stands. A number stands for so many times the unit matrix, a vector for a
/// diagonal.
struct CostWeight {
    ArrayValue value;
    SourceRange where;
};

/// The integral of x'Qx + u'Ru.
struct QuadraticCost {
    CostWeight Q, R;
};

struct LinearisedScene {
    std::string model, scene, form;
    std::vector<std::string> states, inputs;
    std::vector<std::string>
        following; ///< matrices of [reconstruct], which are no states here: nothing depends on them
    MotionPoint start;
    Equilibrium equilibrium;
    linear::LinearSystem system;
    std::vector<linear::Mode> modes; ///< of A, by real, then by imaginary parts
    std::optional<linear::Regulator> regulator;
};

/// With the gain of least `cost`, where there is one. `checked` gets the scene's parameters. Throws MathematicsError: a
/// form without rates of x and y, explicit time, a matrix of [reconstruct] that acts on the motion, an input that is no
/// finite number, no equilibrium, no gain; ModelError where a weight is no number, vector or matrix of that many rows,
/// not symmetric, Q not semidefinite, R not definite.
[[nodiscard]] LinearisedScene linearize_scene(CheckedModel& checked, const Scene& scene,
                                              const std::optional<QuadraticCost>& cost);

} // namespace lagen
