// SPDX-License-Identifier: GPL-2.0-or-later
/// Pontryagin's equations of an optimal control problem on a Lie algebroid, normal extremals, for a person to read:
///   H(x, mu, u) = mu_a sigma^a(x, u) - cost(x, u),   u maximises H: dH/du^A = 0 where no bound is reached
///   xdot^i = rho^i_a sigma^a,   mudot_a = -rho_a(H) - mu_c C^c_ab sigma^b,   dH/dt = dH/dt at fixed x, mu, u
///                                                                                            [Martinez 2004]
#pragma once

#include "equations/kept_symbols.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Blocks: Hamiltonian, labels of the leaves where there are any, section of the controls, condition for the controls,
/// optimal angles (verify/angle_controls.hpp), where dH/du is affine in u with a regular matrix optimal controls and
/// maximal Hamiltonian (stationary controls alone where `maximum` is not proved), kinematics, equations of motion,
/// energy balance where it is not zero. Throws MathematicsError where the model has no controls, and where H has no
/// maximum or no dH/du.
[[nodiscard]] EquationSet derive_pontryagin(const Model& model, const WrittenAlgebroid& algebroid,
                                            const ControlMaximum& maximum,
                                            Definitions definitions = Definitions::expanded);

} // namespace lagen
