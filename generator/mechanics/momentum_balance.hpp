// SPDX-License-Identifier: GPL-2.0-or-later
/// What the equations of Lagrange, Hamilton and Pontryagin share: with f = L at fixed y, or f = -H at fixed mu,
///   xdot^i = rho^i_a y^a,   pdot_a = rho_a(f) - p_c C^c_ab y^b + Q_a,   dE/dt = Q_a y^a - df/dt - p_c C^c_ab y^a y^b
/// (the last sum is zero where C is antisymmetric).                                  [Martinez 2001, 2004]
#pragma once

#include "mechanics/system.hpp"

namespace lagen {

struct MomentumBalance {
    std::vector<NodeId> df_dx;  ///< shape (n)
    NodeId df_dt = 0;           ///< at a fixed state
    std::vector<NodeId> p;      ///< p_a, shape (r)
    std::vector<NodeId> y;      ///< y^a, shape (r)
    std::vector<NodeId> forces; ///< Q_a, shape (r)
};

/// df/dx^i, shape (n), and df/dt at fixed y or mu, by one sweep.
struct BaseSlopes {
    std::vector<NodeId> x;
    NodeId t = 0;
};
[[nodiscard]] BaseSlopes base_slopes(Graph& graph, const System& system, NodeId f);

/// xdot^i = rho^i_a y^a, shape (n).
[[nodiscard]] std::vector<NodeId> base_velocity(Graph& graph, const Algebroid& algebroid, const std::vector<NodeId>& y);

/// pdot_a, shape (r).
[[nodiscard]] std::vector<NodeId> momentum_rates(Graph& graph, const Algebroid& algebroid,
                                                 const MomentumBalance& balance);

/// dE/dt; the last sum is folded over a <= b, where C^c_ab + C^c_ba is zero at a glance.
[[nodiscard]] NodeId energy_rate(Graph& graph, const Algebroid& algebroid, const MomentumBalance& balance);

/// a_k b^k
[[nodiscard]] NodeId contraction(Graph& graph, const std::vector<NodeId>& a, const std::vector<NodeId>& b);

} // namespace lagen
