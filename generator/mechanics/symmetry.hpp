// SPDX-License-Identifier: GPL-2.0-or-later
/// What a section s = s^a e_a of E does to the functions of a system. Its complete lift is
///   s^c = s^a X_a + (y^b rho_b(s^a) + C^a_bd y^b s^d) V_a      on E                             [Martinez 2001]
/// and on arrows <-s - ->s. Where the derivative vanishes the momentum of s is conserved (Noether):
///   d/dt (p_a s^a) = s^c(L) + Q_a s^a,      F^+L_a(g) s^a(t(g)) - F^-L_a(g) s^a(s(g)) = (<-s - ->s)(L)(g)
#pragma once

#include "mechanics/lagrange.hpp"

namespace lagen {

/// s^c(f) = s^a rho_a(f) + (y^b rho_b(s^a) + C^a_bd y^b s^d) df/dy^a of a function f(t, x, y).
[[nodiscard]] NodeId lift_of_function(Graph& graph, const System& system, NodeId f, const std::vector<NodeId>& s);

/// s^c(L) = s^a rho_a(L) + (y^b rho_b(s^a) + C^a_bd y^b s^d) p_a
[[nodiscard]] NodeId lift_of_lagrangian(Graph& graph, const System& system, const LagrangianNodes& lagrangian,
                                        const std::vector<NodeId>& s);

/// d/dt (mu_a s^a) = mu_a rho_b(s^a) H_b - (rho_a(H) + mu_c C^c_ab H_b) s^a along Hamilton's equations of H without
/// forces, H_b = dH/dmu_b.
[[nodiscard]] NodeId lift_of_hamiltonian(Graph& graph, const System& system, const std::vector<NodeId>& s);

/// (<-s - ->s)(L) over the coordinates of an arrow.
[[nodiscard]] NodeId lift_of_discrete_lagrangian(Graph& graph, const System& system, const std::vector<NodeId>& s);

} // namespace lagen
