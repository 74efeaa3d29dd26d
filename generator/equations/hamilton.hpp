// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton's equations on the dual of a Lie algebroid, symbolic, for a person to read:
///   xdot^i = rho^i_a dH/dmu_a,   mudot_a = -rho_a(H) - mu_c C^c_ab dH/dmu_b + Q_a(t, x, dH/dmu)
///   {mu_a, x^j} = rho^j_a,   {mu_a, mu_b} = C^c_ab mu_c,   Fdot = {H, F} + dF/dt + Q_a dF/dmu_a
///   dH/dt = Q_a dH/dmu_a + (dH/dt at fixed x, mu)                          [de Leon-Marrero-Martinez 2005]
/// H is the model's own, or the Legendre transform of its L: written out where the momenta are affine in y with a W
/// that falls into small blocks, else left implicit, with y(x, mu) from mu_a = dL/dy^a, rho_a(H) = -rho_a(L) at that y.
#pragma once

#include "equations/kept_symbols.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Blocks: Hamiltonian, labels of the leaves where there are any, velocities, kinematics, equations of motion, energy
/// balance where it is not zero, Poisson brackets. Throws MathematicsError where the model has neither H nor L, and
/// where it has no H and `regularity` says that L is degenerate or its momenta are not shown to fix the velocities.
[[nodiscard]] EquationSet derive_hamilton(const Model& model, const WrittenAlgebroid& algebroid,
                                          const Regularity& regularity = {},
                                          Definitions definitions = Definitions::expanded);

} // namespace lagen
