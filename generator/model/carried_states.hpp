// SPDX-License-Identifier: GPL-2.0-or-later
/// Which first-order states a motion is integrated with: those that act on it, and those that somebody looks at.
#pragma once

#include "model/model.hpp"

namespace lagen {

/// Numbers of the states of [states], ascending, that forces, invariants or the scene's columns, events and time scale
/// use, and those that these follow from. Without a scene, and where the scene does not choose its columns: all but
/// `total_cost`, which is carried where it is named alone (without a scene in observables, invariants or events), and
/// in Pontryagin's form.
[[nodiscard]] std::vector<std::size_t> carried_states(const Model& model, const std::string& form, const Scene* scene);

/// True where `tree` uses a state that is not among `carried`.
[[nodiscard]] bool uses_other_states(const Model& model, const Tree& tree, const std::vector<std::size_t>& carried);

} // namespace lagen
