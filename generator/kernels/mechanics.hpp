// SPDX-License-Identifier: GPL-2.0-or-later
/// The Lagrangian formulation as nodes of a graph: everything that a kernel returns is one of these or made from them.
#pragma once

#include "geometry/verify.hpp"
#include "graph/kernel.hpp"
#include "graph/lower.hpp"

namespace lagen {

/// Shapes and index order as in the notation table: rho(i, a) at i * r + a, W(a, b) at a * r + b.
struct LagrangeNodes {
    NodeId time = 0;
    std::vector<NodeId> x; ///< x^i, shape (n)
    std::vector<NodeId> y; ///< y^a, shape (r)
    std::vector<NodeId> parameters;
    NodeId lagrangian = 0;
    NodeId energy = 0;            ///< y^a p_a - L
    std::vector<NodeId> momentum; ///< p_a = dL/dy^a, shape (r)
    std::vector<NodeId> W;        ///< d2L/dy^a dy^b, shape (r, r), symmetric node by node
    std::vector<NodeId> xdot;     ///< rho^i_a y^a, shape (n)
    std::vector<NodeId> ydot;     ///< shape (r); empty unless asked for
    std::vector<NodeId> pivots;   ///< 1 x 1 blocks of W: the divisors in ydot that are no `factor`
    Binding binding;              ///< every name that observables and events may use: t, parameters, x, y, momenta,
                                  ///< energy, lagrangian (what the model declares wins)
};

/// L, rho and C lowered as the user wrote them and differentiated: p by one reverse sweep of L, W by forward sweeps of
/// p, and (d2L/dy dx) rho y + d2L/dy dt by one forward sweep of p along (xdot, 1). Accelerations only with
/// `accelerations`.
[[nodiscard]] LagrangeNodes lagrange_nodes(Graph& graph, const Model& model, const VerifiedAlgebroid& verified,
                                           bool accelerations);

} // namespace lagen
