// SPDX-License-Identifier: GPL-2.0-or-later
/// L and its first and second derivatives on a graph, from the user's own form: p by one reverse sweep of L, W by
/// forward sweeps of p.
#pragma once

#include "geometry/verify.hpp"
#include "kernels/system.hpp"

namespace lagen {

struct LagrangianNodes {
    NodeId value = 0;             ///< L(t, x, y)
    std::vector<NodeId> y;        ///< input nodes y^a, shape (r)
    std::vector<NodeId> momentum; ///< p_a = dL/dy^a, shape (r)
    std::vector<NodeId> dL_dx;    ///< shape (n)
    NodeId dL_dt = 0;
    NodeId energy = 0;     ///< y^a p_a - L
    std::vector<NodeId> W; ///< d2L/dy^a dy^b, shape (r, r), W(a, b) at a * r + b, symmetric node by node
};

[[nodiscard]] LagrangianNodes lagrangian_nodes(Graph& graph, const Model& model, const SystemNodes& system);

/// What is known of W for every value of the parameters. (What holds for the file's values alone says nothing of a
/// header whose parameters may be changed.)
[[nodiscard]] MatrixStructure mass_structure(const Regularity& regularity);

/// Throws MathematicsError, which names `form`, where there is no L or it is degenerate.
void require_regular_lagrangian(const Model& model, const Regularity& regularity, const char* form);

} // namespace lagen
