// SPDX-License-Identifier: GPL-2.0-or-later
/// The Cartan sections of L in continuous time for a person, with what is decided of them (mechanics/symplectic.hpp).
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// theta_L, omega_L, E_L and the complete lifts of the basis, and for all states
///   -d theta_L = omega_L,      i_Gamma omega_L = dE_L - Q_a X^a + (dp_a/dt) X^a,      d_Gamma theta_L = dL + ..
///   [e_a^c, e_b^c] = [e_a, e_b]^c,   [e_a^c, e_b^v] = [e_a, e_b]^v
/// with W_ab f^b of Lagrange's equations; whether omega_L is symplectic is what `regularity` says of W. Throws
/// MathematicsError where the model has no L.
[[nodiscard]] EquationSet derive_lagrangian_cartan(const Model& model, const System& system,
                                                   const Regularity& regularity);

} // namespace lagen
