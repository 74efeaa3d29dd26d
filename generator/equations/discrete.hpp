// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete Lagrangian mechanics for a person: the target of an arrow g, the momenta F^-L(g) at its source and F^+L(g)
/// at its target, and the discrete Euler-Lagrange equations F^+L(g) = F^-L(h) of two arrows with t(g) = s(h).
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "notation/equation_set.hpp"

namespace lagen {

/// Throws MathematicsError where the model has no discrete Lagrangian that is written out.
[[nodiscard]] EquationSet derive_discrete(const Model& model, const System& system);

} // namespace lagen
