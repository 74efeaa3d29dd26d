// SPDX-License-Identifier: GPL-2.0-or-later
/// The Cartan sections of a discrete Lagrangian L on a Lie groupoid G, on the prolongation of G: the Lie algebroid over
/// the arrows g with the 2r sections E-_a, E+_a and
///   rho(E-_a) = -(->e_a),                          rho(E+_a) = <-e_a
///   [E-_a, E-_b] = C^c_ab(s(g)) E-_c,              [E+_a, E+_b] = C^c_ab(t(g)) E+_c,        [E-_a, E+_b] = 0
/// They are
///   Theta- = F^-L_a E-^a,      Theta+ = F^+L_a E+^a,      Omega_L = <-e_b(->e_a(L)) E-^a ^ E+^b
/// so that dL = Theta+ - Theta- and Omega_L = -dTheta- = -dTheta+. L is regular where Omega_L is symplectic. [Martinez
/// 2001; Marrero-Martin de Diego-Martinez 2006]
#pragma once

#include "geometry/form.hpp"
#include "mechanics/discrete.hpp"

namespace lagen {

struct CartanSections {
    Algebroid prolongation;   ///< sections in the order E-_1 .. E-_r, E+_1 .. E+_r; x: the coordinates of an arrow
    ExteriorForm minus, plus; ///< Theta-, Theta+
    ExteriorForm omega;       ///< Omega_L: Newton's matrix N_ab at (a, r + b)
};

/// Of a system with a discrete Lagrangian.
[[nodiscard]] CartanSections cartan_sections(Graph& graph, const System& system);

/// Theta+ - Theta- by the product of G alone, eta_a a curve of arrows in the direction of e_a from an arrow 1:
///   F^-L_a = -d/ds L(eta_a(s)^-1 g),      F^+L_a = d/ds L(g eta_a(s))      at s = 0
[[nodiscard]] ExteriorForm translated_momenta(Graph& graph, const System& system);

} // namespace lagen
