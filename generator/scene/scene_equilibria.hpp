// SPDX-License-Identifier: GPL-2.0-or-later
/// Relative equilibria of a model with the values of momenta and Casimirs at the start of a scene.
#pragma once

#include "analysis/relative_equilibria.hpp"
#include "pipeline.hpp"

namespace lagen {

struct SceneEquilibria {
    RelativeEquilibria all;
    std::vector<std::string> coordinates, cyclic; ///< their names
    std::vector<std::string> functions;           ///< the conserved ones as a person writes them
    std::vector<std::vector<double>> velocities;  ///< y of each that was found
};

/// Sought from so many random points. `checked` gets the scene's parameters. Throws MathematicsError where the model
/// has no Hamiltonian in closed form, forces or explicit time, and as evaluate_scene does.
[[nodiscard]] SceneEquilibria scene_equilibria(CheckedModel& checked, const Scene& scene, std::size_t starts);

} // namespace lagen
