// SPDX-License-Identifier: GPL-2.0-or-later
/// The expressions of a model, for what must hold of all of them.
#pragma once

#include "mechanics/written_algebroid.hpp"
#include "model/model.hpp"

namespace lagen {

/// Closed trees in this order: definitions (used or not), domain, constraints, Casimirs, rho, C, L, R, forces,
/// invariants, observables, events. A definition that cannot be closed by itself (a function of vectors) is seen where
/// it is used.
[[nodiscard]] std::vector<Tree> all_trees(const Model& model, const WrittenAlgebroid& algebroid);

/// What stands on E* and on the controls: H, sigma, cost, bounds, terminal cost.
[[nodiscard]] std::vector<Tree> phase_trees(const Model& model);

/// What the structure and the mechanics are made of, as written and as built: domain, constraints, Casimirs, rho, C, L,
/// R and forces, the blocks of the algebroid down to the innermost, and phase_trees. A point counts where all of them
/// are defined.
[[nodiscard]] std::vector<Tree> structure_trees(const Model& model, const WrittenAlgebroid& algebroid);

} // namespace lagen
