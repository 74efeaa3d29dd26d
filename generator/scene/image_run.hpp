// SPDX-License-Identifier: GPL-2.0-or-later
/// The motion of the target of a morphism from the image of the start of a scene of its source, beside the image of the
/// motion of the source; and the lift of the one to the other.
#pragma once

#include "scene/projection.hpp"
#include "scene/scene_run.hpp"

namespace lagen {

/// Largest |difference| of one column.
struct ColumnDefect {
    std::string name;
    bool lifted = false;  ///< of the reconstruction, else of the projection
    double max = 0;       ///< infinite where a value is no finite number
    double time = 0;      ///< of the largest
    double size = 0;      ///< largest value of the column
    double moved_at = -1; ///< when it first was more than 1e-3 of `size`, and whether it was
    bool moved = false;
};

struct RunComparison {
    Table table; ///< t, the columns of the projection ("source_NAME" of what is lifted), then their images:
                 ///< "projected_NAME", "pulled_NAME", "lifted_NAME"
    std::vector<ColumnDefect> defects; ///< one a column
};

struct ImageRun {
    RunOutcome source;                ///< with the columns that were asked for
    std::optional<RunOutcome> target; ///< nothing where the source was interrupted, or has no row
    RunComparison comparison;         ///< how far they are apart, row by row
};

/// Lets the scene, which has its form, observe all states and targets of arrows behind what it observes anyway; the
/// number of columns that were asked for.
[[nodiscard]] std::size_t observe_states(const Model& model, Scene& scene);

/// Runs `source`, whose scene observes `asked` columns and then all states, and `target` in the same form. Where it
/// is to `reconstruct`, which takes an isomorphism of fibres, the motion of the target is lifted. Throws
/// MathematicsError where momenta of the source are not those of one start of the target.
[[nodiscard]] ImageRun run_image(SceneRun& source, std::size_t asked, CheckedModel& target, SystemMorphism map,
                                 bool reconstruct, SecondRun second);

} // namespace lagen
