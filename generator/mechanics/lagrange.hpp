// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations on a Lie algebroid, with explicit time and forces:
///   p_a = dL/dy^a,   W_ab = d2L/dy^a dy^b,   E = y^a p_a - L
///   W_ab ydot^b = rho_a(L) + Q_a - p_c C^c_ab y^b - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt     [Martinez 2001]
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "mechanics/nonholonomic.hpp"

namespace lagen {

/// L with its derivatives; p and W in `fibre`. Of a nonholonomic system L is l(t, x, y) = L(t, x, b + y^alpha e_alpha).
struct LagrangianNodes {
    FibreHessian fibre;
    std::vector<NodeId> dL_dx; ///< shape (n)
    NodeId dL_dt = 0;
    NodeId energy = 0; ///< y^a p_a - L; of a nonholonomic system Y^a P_a - L
    std::optional<ConstrainedNodes> constrained;
};
/// Of a system that has L.
[[nodiscard]] LagrangianNodes lagrangian_nodes(Graph& graph, const System& system);

/// What momentum_rates and energy_rate take; of a nonholonomic system over its hull.
[[nodiscard]] MomentumBalance lagrange_balance(Graph& graph, const System& system, const LagrangianNodes& lagrangian);

/// Rates along the equations of motion; W ydot = force = pdot - [dp/dt along (xdot, 1) at fixed y], one forward sweep
/// of p.
struct LagrangeRates {
    std::vector<NodeId> xdot;        ///< shape (n)
    std::vector<NodeId> pdot, force; ///< one a velocity
};
[[nodiscard]] LagrangeRates lagrange_rates(Graph& graph, const System& system, const LagrangianNodes& lagrangian,
                                           const MomentumBalance& balance);

/// dE/dt where it is free of accelerations: nothing of a nonholonomic system with a drift, whose reactions do work.
[[nodiscard]] std::optional<NodeId> lagrange_power(Graph& graph, const System& system,
                                                   const LagrangianNodes& lagrangian, const MomentumBalance& balance);

} // namespace lagen
