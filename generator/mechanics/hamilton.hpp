// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton's equations on E*:
///   xdot^i = rho^i_a y^a,   mudot_a = -(rho_a(H) + mu_c C^c_ab y^b) + Q_a,   y^a = dH/dmu_a      [Martinez 2001]
/// From L without forming H: y solves mu_a = dL/dy^a, and at that y dH/dx^i = -dL/dx^i, dH/dt = -dL/dt.
#pragma once

#include "graph/unknowns/implicit.hpp"
#include "mechanics/lagrange.hpp"
#include "mechanics/phase_motion.hpp"

namespace lagen {

/// Everything of H that its equations need, over x, mu and, where y is implicit, the unknowns y.
struct HamiltonianNodes {
    NodeId value = 0;
    NodeId lagrangian = 0;     ///< mu_a y^a - H
    std::vector<NodeId> mu;    ///< inputs, shape (r)
    std::vector<NodeId> y;     ///< dH/dmu_a, shape (r)
    std::vector<NodeId> dH_dx; ///< at fixed mu, shape (n)
    NodeId dH_dt = 0;
    std::optional<ConstrainedNodes> constrained; ///< of a nonholonomic system, at y(x, mu); `value` is h on D*
    std::vector<NodeId> matrix;                  ///< that y was solved with, shape (r, r); empty: none
    std::vector<ImplicitBlock> implicit;         ///< where mu is not affine in y
};

/// Of a system that has H.
[[nodiscard]] HamiltonianNodes given_hamiltonian(Graph& graph, const System& system);

/// Legendre's transform of L: y(x, mu) by a linear solve where p is affine in y, else an implicit block. `structure`:
/// what is known of W; `start`: a y where dL/dy is defined, if it is not at 0.
[[nodiscard]] HamiltonianNodes legendre_transform(Graph& graph, const System& system, const LagrangianNodes& lagrangian,
                                                  MatrixStructure structure, std::span<const Rational> start);

/// H, else the transform of L, which is not degenerate; nothing where there is neither, or where velocities are
/// implicit. `start` as for legendre_transform.
[[nodiscard]] std::optional<HamiltonianNodes> closed_hamiltonian(Graph& graph, const System& system,
                                                                 std::span<const Rational> start);

/// What momentum_rates and energy_rate take: f = -H, and the forces of the system at y = dH/dmu; of a nonholonomic
/// system over its hull.
[[nodiscard]] MomentumBalance hamilton_balance(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian);

/// Hamilton's equations: f = -H, and the forces of the system at y = dH/dmu.
[[nodiscard]] PhaseSystem hamilton_system(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian);

} // namespace lagen
