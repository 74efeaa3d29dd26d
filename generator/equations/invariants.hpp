// SPDX-License-Identifier: GPL-2.0-or-later
/// Invariants of Hamilton's equations that are found without help: `derive --form invariants`.
#pragma once

#include "model/model.hpp"
#include "notation/equation_set.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Each function of the ansatz of verify/find_invariants.hpp with rate zero, with the statement that it is.
/// Throws MathematicsError where the model has no H in closed form, or one with explicit time.
[[nodiscard]] EquationSet derive_invariants(const Model& model, const System& system, const Regularity& regularity);

} // namespace lagen
