// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations on a Lie algebroid, symbolic, for a person to read:
///   xdot^i = rho^i_a y^a,   p_a = dL/dy^a,   d/dt p_a = rho_a(L) - p_c C^c_ab y^b + Q_a               (momentum form)
///   W_ab ydot^b = rho_a(L) - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b + Q_a     (acceleration form)
///   Q_a = forces_a - dR/dy^a,   E_L = y^a p_a - L,   dE_L/dt = Q_a y^a - dL/dt                   [Martinez 2001]
#pragma once

#include "equations/kept_symbols.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Blocks: kinematics, labels of the leaves where there are any, momenta, equations of motion (momentum form),
/// (acceleration form), energy, energy balance where it is not zero; where L is degenerate, the kernel of W as far
/// as `regularity` has it. Throws MathematicsError where the model has no Lagrangian.
[[nodiscard]] EquationSet derive_lagrange(const Model& model, const WrittenAlgebroid& algebroid,
                                          const Regularity& regularity = {},
                                          Definitions definitions = Definitions::expanded);

} // namespace lagen
