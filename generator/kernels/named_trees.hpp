// SPDX-License-Identifier: GPL-2.0-or-later
/// The functions that a model and its scenes name, as trees. The inputs u of a scene that gives them by expressions are
/// inserted before kernels are made, so that a feedback law is a part of the right-hand side, its derivatives and
/// events.
#pragma once

#include "graph/kernel.hpp"
#include "mechanics/system.hpp"
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

/// Every input with its value, the default where the scene has none. Empty where nothing is to be inserted: without a
/// scene, and where a table gives the inputs while the program runs.
[[nodiscard]] std::vector<NamedTree> given_inputs(const Model& model, const Scene* scene);

/// The system with these in the place of its inputs, in forces and sigma. Trees keep their names.
[[nodiscard]] System insert_inputs(System system, const std::vector<NamedTree>& inputs);

} // namespace lagen
