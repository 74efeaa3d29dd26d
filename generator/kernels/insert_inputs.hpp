// SPDX-License-Identifier: GPL-2.0-or-later
/// The inputs u of a scene that gives them by expressions: they are inserted before kernels are made, so that a
/// feedback law is a part of the right-hand side, its derivatives and its events.
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"

namespace lagen {

/// Every input with its value, the default where the scene has none. Empty where nothing is to be inserted: without a
/// scene, and where a table gives the inputs while the program runs.
[[nodiscard]] std::vector<NamedTree> given_inputs(const Model& model, const Scene* scene);

/// The system with these in the place of its inputs, in forces and sigma. Trees keep their names.
[[nodiscard]] System insert_inputs(System system, const std::vector<NamedTree>& inputs);

} // namespace lagen
