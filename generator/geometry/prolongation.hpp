// SPDX-License-Identifier: GPL-2.0-or-later
/// The prolongation T^E P of a Lie algebroid E over P = E or P = E*, with fibre coordinates z (y^a, or mu_a): the Lie
/// algebroid over the points (x, z) with the sections X_1 .. X_r, V_1 .. V_r and
///   rho(X_a) = rho^i_a d/dx^i,  rho(V_a) = d/dz_a,      [X_a, X_b] = C^c_ab X_c,  [X_a, V_b] = [V_a, V_b] = 0
/// and the lifts of a section s of E to it, over P = E:
///   s^v = s^a V_a,      s^c = s^a X_a + (y^b rho_b(s^a) + C^a_bd y^b s^d) V_a
///   [s^c, t^c] = [s, t]^c,   [s^c, t^v] = [s, t]^v,   [s^v, t^v] = 0                              [Martinez 2001]
#pragma once

#include "geometry/section.hpp"

namespace lagen {

/// `z`: inputs, shape (r). Sections in the order X_1 .. X_r, V_1 .. V_r.
[[nodiscard]] Algebroid prolongation(Graph& graph, const Algebroid& algebroid, const std::vector<NodeId>& z);

/// Components over x (and, of s^c, y) by the sections of the prolongation.
[[nodiscard]] Section vertical_lift(const Algebroid& algebroid, const Section& s);
[[nodiscard]] Section complete_lift(BaseGradient& partial, const Algebroid& algebroid, const Section& s);

} // namespace lagen
