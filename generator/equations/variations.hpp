// SPDX-License-Identifier: GPL-2.0-or-later
/// The variations of E-paths and of the action of L for a person, with what is decided of them
/// (mechanics/variations.hpp).
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"

namespace lagen {

/// delta x^i, delta y^a, delta p_a, Jacobi's equations, delta^2 L; and for all curves (x, y) with xdot = rho(y), all s,
/// r
///   delta_s (rho(y)) = d/dt (delta_s x),      [delta_s, delta_r] = delta_[s, r],      delta L = EL_a s^a + d/dt (p_a
///   s^a) d q/d s^a - d/dt (d q/d sdot^a) = delta EL_a + 1/2 C^c_ab s^b EL_c,      q = 1/2 delta^2 L
/// Throws MathematicsError where the model has no L, and where forces act.
[[nodiscard]] EquationSet derive_variations(const Model& model, const System& system);

} // namespace lagen
