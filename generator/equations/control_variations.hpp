// SPDX-License-Identifier: GPL-2.0-or-later
/// Variations of the controlled curves of an optimal control problem, by a curve of sections eta(t) and by du(t):
///   delta x^i = rho^i_a eta^a,      etadot^a = rho_b(sigma^a) eta^b + (dsigma^a/du^A) delta u^A - C^a_bc sigma^b eta^c
/// The second is that they are variations of the E-path y = sigma(x, u): those within one E-homotopy class. Along
/// Pontryagin's mudot, at every u,
///   delta L = d/dt (mu_a eta^a) - (dH/du^A) delta u^A
/// so that the cost is critical among controlled curves in the class, eta = 0 at the ends, where dH/du = 0.
///                                                                                                  [Martinez 2004]
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"

namespace lagen {

/// Of a model that has [control]. Throws MathematicsError where the derivation fails.
[[nodiscard]] EquationSet derive_control_variations(const Model& model, const System& system);

} // namespace lagen
