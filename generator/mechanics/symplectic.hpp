// SPDX-License-Identifier: GPL-2.0-or-later
/// The Cartan sections of L on the prolongation T^E E (sections X_a, V_a), and the canonical ones on T^E E* (X_a, P^a),
///   theta_L = p_a X^a,      omega_L = W_ab X^a ^ V^b + 1/2 (rho_b(p_a) - rho_a(p_b) + p_c C^c_ab) X^a ^ X^b
///   Theta = mu_a X^a,       Omega = X^a ^ P_a + 1/2 mu_c C^c_ab X^a ^ X^b
/// with p_a = dL/dy^a, W_ab = d2L/dy^a dy^b, rho_b(p_a) at fixed y; omega_L = -d theta_L, Omega = -d Theta. A section
/// Gamma = y^a X_a + f^a V_a solves Lagrange's equations where i_Gamma omega_L = dE_L; X_H solves Hamilton's where
/// i_{X_H} Omega = dH. The bracket of functions on E* is
///   {F, G} = F_a rho_a(G) - G_a rho_a(F) + mu_c C^c_ab F_a G_b,      F_a = dF/dmu_a,
/// so that Fdot = {H, F} and {F, G} = -Omega(X_F, X_G).                                          [Martinez 2001]
#pragma once

#include "geometry/form.hpp"
#include "mechanics/lagrange.hpp"

namespace lagen {

struct SymplecticForms {
    Algebroid prolongation; ///< sections in the order X_1 .. X_r, V_1 .. V_r (P^1 .. P^r)
    ExteriorForm theta, omega;
};

/// theta_L and omega_L of a system that has L.
[[nodiscard]] SymplecticForms lagrangian_forms(Graph& graph, const System& system, const LagrangianNodes& lagrangian);
/// Theta and Omega.
[[nodiscard]] SymplecticForms canonical_forms(Graph& graph, const System& system);

/// {F, G} of functions of t, x, mu.
[[nodiscard]] NodeId poisson_bracket(Graph& graph, const System& system, NodeId F, NodeId G);

/// X_F with i_{X_F} Omega = dF: dF/dmu_a X_a - (rho_a(F) + mu_c C^c_ab dF/dmu_b) P^a.
[[nodiscard]] Section hamiltonian_section(Graph& graph, const System& system, NodeId F);

} // namespace lagen
