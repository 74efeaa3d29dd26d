// SPDX-License-Identifier: GPL-2.0-or-later
/// The functions that a model and its scenes name, as trees.
#pragma once

#include "graph/kernel.hpp"
#include "model/model.hpp"

namespace lagen {

[[nodiscard]] std::vector<NamedTree> constraint_trees(const Model& model);

/// Those of the model, then what `scene` (if it is not null) asks for that is neither one of `lanes` nor one of them:
/// its columns (where it names none, `states`) and the coordinates of its curves.
[[nodiscard]] std::vector<NamedTree> observable_trees(const Model& model, const Scene* scene,
                                                      const std::vector<std::string>& states,
                                                      const std::vector<Quantity>& lanes);

/// Of `scene`, or of all where it is null; the same event of two scenes once, different ones of one name with the
/// scene's name in front.
[[nodiscard]] std::vector<NamedTree> event_trees(const Model& model, const Scene* scene);

} // namespace lagen
