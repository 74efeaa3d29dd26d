// SPDX-License-Identifier: GPL-2.0-or-later
/// Mechanics on E constrained to Y = b + y^alpha e_alpha, e_alpha = A_alpha^a e_a, by d'Alembert's principle:
///   l(t, x, y) = L(t, x, b + y^alpha e_alpha),   p_alpha = dl/dy^alpha = A_alpha^a P_a,   P_a = dL/dY^a
///   xdot = rho(b) + y^alpha rho(e_alpha)
///   d/dt p_alpha = rho(e_alpha)(l) - P_a [e_alpha, b + y^beta e_beta]^a + P_a dA_alpha^a/dt + A_alpha^a Q_a      (N)
/// without a complement of D and for every L. The sections e_alpha, and b behind them with the weight 1, span the hull
/// of b + D; with its brackets in the frame of E its momentum balance is that of mechanics/momentum_balance.hpp. Of b
///   b^c(L) = rho(b)(l) - P_a [b, b + y^beta e_beta]^a,
///   d/dt (E - P_a b^a) = Q_a (Y^a - b^a) - dL/dt - P_a db^a/dt - b^c(L),   E = Y^a P_a - L,   E - P_a b^a = y^alpha
///   p_alpha - l
/// and the reactions are lambda_a = d/dt P_a - rho_a(L) + P_c C^c_ab Y^b - Q_a, with lambda_a A_alpha^a = 0.
/// [Cortes, de Leon, Marrero, Martinez 2009]
#pragma once

#include "mechanics/momentum_balance.hpp"

namespace lagen {

/// The sections e_alpha, and b behind them where there is a drift.
struct ConstraintHull {
    Algebroid frame;             ///< their anchors and, in the frame of E, their brackets; its y are the weights
    std::vector<NodeId> weights; ///< y^alpha, then 1
    std::vector<Section> sections;
    std::vector<NodeId> Y; ///< Y^a = b^a + A_alpha^a y^alpha, shape (r)
    std::size_t k = 0;     ///< how many are e_alpha

    [[nodiscard]] bool has_drift() const { return sections.size() > k; }
};
[[nodiscard]] ConstraintHull constraint_hull(Graph& graph, const System& system);

/// L and Q on the constraint, functions of t, x, y.
struct ConstrainedNodes {
    ConstraintHull hull;
    NodeId lagrangian = 0;      ///< l
    std::vector<NodeId> P;      ///< shape (r)
    std::vector<NodeId> dL_dx;  ///< at fixed Y, shape (n)
    NodeId dL_dt = 0;           ///< at fixed Y
    std::vector<NodeId> forces; ///< Q_a, shape (r)
};
/// Of a system that has L and a distribution.
[[nodiscard]] ConstrainedNodes constrained_nodes(Graph& graph, const System& system);

/// The same functions with y replaced, as by y(x, mu).
[[nodiscard]] ConstrainedNodes at_velocities(Graph& graph, ConstrainedNodes nodes, const Replacements& y);
/// E = Y^a P_a - L.
[[nodiscard]] NodeId constrained_energy(Graph& graph, const ConstrainedNodes& nodes);

/// What momentum_rates takes over the hull; `dl_dx`, `dl_dt` at fixed y.
[[nodiscard]] MomentumBalance constrained_balance(Graph& graph, const ConstrainedNodes& nodes,
                                                  std::vector<NodeId> dl_dx, NodeId dl_dt);

/// d/dt p_alpha of (N), shape (k), from the rates over the hull.
[[nodiscard]] std::vector<NodeId> constrained_rates(Graph& graph, const System& system, const ConstrainedNodes& nodes,
                                                    const std::vector<NodeId>& hull_rates);

/// E - P_a b^a.
[[nodiscard]] NodeId moving_energy(Graph& graph, const ConstrainedNodes& nodes);
/// Its rate, free of reactions; `balance`: over the hull.
[[nodiscard]] NodeId moving_energy_rate(Graph& graph, const System& system, const ConstrainedNodes& nodes,
                                        const MomentumBalance& balance);

/// lambda_a, shape (r), along the motion with these rates of x and y and of time.
[[nodiscard]] std::vector<NodeId> reaction(Graph& graph, const System& system, const ConstrainedNodes& nodes,
                                           const Replacements& rates);

/// {F, G} = F^alpha rho(e_alpha)(G) - G^alpha rho(e_alpha)(F) + P_a [e_alpha, e_beta]^a F^alpha G^beta on D*, F^alpha =
/// dF/dp_alpha; `nodes` at y(x, p). Without drift, forces and explicit time Fdot = {h, F}.
[[nodiscard]] NodeId almost_poisson_bracket(Graph& graph, const System& system, const ConstrainedNodes& nodes, NodeId F,
                                            NodeId G);

/// The ambient coordinates that are no velocities themselves, with their values Y.
[[nodiscard]] Binding ambient_names(const System& system, const std::vector<NodeId>& Y);

} // namespace lagen
