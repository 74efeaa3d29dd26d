// SPDX-License-Identifier: GPL-2.0-or-later
/// The model file of a Routh reduction: the file of the whole model with what the reduction changes. Velocities of
/// cyclic coordinates become definitions and the coordinates first-order states, so that forces, observables and events
/// stand as they did, and an angle is integrated where it is observed; momenta become parameters, with values from the
/// scenes.
#pragma once

#include "equations/routh.hpp"
#include "model/read_model.hpp"

namespace lagen {

/// `settings`: values of parameters from the command line; `nonzero`: what the momenta determine the velocities where
/// it is not 0, for the domain. Throws MathematicsError for what of a model is not reduced.
[[nodiscard]] std::string routh_document(const Model& model, const std::vector<Setting>& settings,
                                         const std::vector<std::size_t>& cyclic, const RouthianText& text,
                                         const std::vector<Tree>& nonzero);

/// The coordinates of these names. Throws where one is none, where the model is not of the sort that is reduced, and
/// where none would be left.
[[nodiscard]] std::vector<std::size_t> coordinates_to_reduce(const Model& model, const std::vector<std::string>& names);

} // namespace lagen
