// SPDX-License-Identifier: GPL-2.0-or-later
/// The Cartan sections of a discrete Lagrangian for a person, with what is decided of them (mechanics/cartan.hpp).
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"

namespace lagen {

/// Theta-(E-_a), Theta+(E+_a), Omega_L(E-_a, E+_b) without the entries that vanish, and for all arrows
///   dL = Theta+ - Theta-      with Theta-(E-_a) = -d/ds L(eta_a(s)^-1 g), Theta+(E+_a) = d/ds L(g eta_a(s))
///   ->e_a <-e_b L = <-e_b ->e_a L,   -dTheta- = Omega_L,   -dTheta+ = Omega_L
/// each proved, refuted or undecided, d of the algebroid of mechanics/cartan.hpp. Throws MathematicsError where the
/// model has no discrete Lagrangian that is written out.
[[nodiscard]] EquationSet derive_cartan(const Model& model, const System& system);

} // namespace lagen
