// SPDX-License-Identifier: GPL-2.0-or-later
/// The least model of a scene as a person reads it, and as a model file of first order that runs in its place.
#pragma once

#include "pipeline.hpp"
#include "text/record.hpp"

namespace lagen {

struct LeastScene {
    Record record;         ///< what `explain --format json` prints
    std::string text;      ///< the same for people
    std::string obstacle;  ///< why the whole model is kept, where the rules cannot be applied; or empty
    std::string unwritten; ///< why there is no document; or empty
    std::string document;  ///< the model file, whose one scene is called as the scene is; empty where not asked for
    std::vector<std::string> columns; ///< what the scene calls the columns, in the order of the document's `observe`
    std::size_t full = 0, least = 0;  ///< states
    std::vector<std::string> relations, not_followed; ///< "k = 0"; "energy"
};

/// Throws MathematicsError as `formulation` does. `scene` has a form.
[[nodiscard]] LeastScene least_scene(const CheckedModel& checked, const Scene& scene, bool with_document);

/// The model of the document, and its scene with the columns as the whole scene calls them.
struct LeastRun {
    CheckedModel model;
    Scene scene;
};
[[nodiscard]] LeastRun least_run(const LeastScene& least);

} // namespace lagen
