// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations on a Lie algebroid, with explicit time and forces:
///   p_a = dL/dy^a,   W_ab = d2L/dy^a dy^b,   E = y^a p_a - L
///   W_ab ydot^b = rho_a(L) + Q_a - p_c C^c_ab y^b - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt     [Martinez 2001]
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "mechanics/momentum_balance.hpp"

namespace lagen {

/// L with its derivatives; p and W in `fibre`.
struct LagrangianNodes {
    FibreHessian fibre;
    std::vector<NodeId> dL_dx; ///< shape (n)
    NodeId dL_dt = 0;
    NodeId energy = 0; ///< y^a p_a - L
};
/// Of a system that has L.
[[nodiscard]] LagrangianNodes lagrangian_nodes(Graph& graph, const System& system);

/// What momentum_rates and energy_rate take.
[[nodiscard]] MomentumBalance lagrange_balance(Graph& graph, const System& system, const LagrangianNodes& lagrangian);

/// The right-hand side of W ydot = pdot - [dp/dt along (xdot, 1) at fixed y], shape (r); one forward sweep of p.
[[nodiscard]] std::vector<NodeId> acceleration_forces(Graph& graph, const System& system,
                                                      const LagrangianNodes& lagrangian,
                                                      const std::vector<NodeId>& pdot);

} // namespace lagen
