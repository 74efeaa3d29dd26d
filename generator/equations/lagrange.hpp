// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations on a Lie algebroid, symbolic, for a person to read:
///   xdot^i = rho^i_a y^a,   p_a = dL/dy^a,   d/dt p_a = rho_a(L) - p_c C^c_ab y^b                    (momentum form)
///   W_ab ydot^b = rho_a(L) - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b                (acceleration
///   form) E_L = y^a p_a - L                                                                     [Martinez 2001]
/// Derived with GiNaC, in an order and with signs of our own, so that the text is the same on every run.
#pragma once

#include "expression/equation_set.hpp"
#include "geometry/algebroid.hpp"

namespace lagen {

/// Blocks: kinematics, momenta, equations of motion (momentum form), (acceleration form), energy.
/// Throws MathematicsError where the model has no Lagrangian.
[[nodiscard]] EquationSet derive_lagrange(const Model& model, const Algebroid& algebroid);

} // namespace lagen
