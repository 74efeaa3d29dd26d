// SPDX-License-Identifier: GPL-2.0-or-later
/// What the equations of Lagrange, Hamilton and Pontryagin share: with f = L at fixed y, or f = -H at fixed mu,
///   xdot^i = rho^i_a y^a,   pdot_a = rho_a(f) - p_c C^c_ab y^b + Q_a,   dE/dt = Q_a y^a - df/dt - p_c C^c_ab y^a y^b
#pragma once

#include "geometry/lowered_algebroid.hpp"
#include "model/model.hpp"

#include <optional>

namespace lagen {

struct MomentumBalance {
    NodeId potential = 0;       ///< f
    std::vector<NodeId> p;      ///< p_a, shape (r)
    std::vector<NodeId> y;      ///< y^a, shape (r)
    std::vector<NodeId> forces; ///< Q_a, shape (r)
};

/// xdot^i, shape (n).
[[nodiscard]] std::vector<NodeId> base_velocity(Graph& graph, const LoweredAlgebroid& algebroid,
                                                const std::vector<NodeId>& y);

/// pdot_a; the partial derivatives of f in x come from `partial`.
[[nodiscard]] NodeId momentum_rate(Graph& graph, const LoweredAlgebroid& algebroid, const MomentumBalance& balance,
                                   BaseGradient& partial, std::size_t a);

/// dE/dt; the last sum is folded over a <= b, where C^c_ab + C^c_ba is zero at a glance.
[[nodiscard]] NodeId energy_rate(Graph& graph, const LoweredAlgebroid& algebroid, const MomentumBalance& balance,
                                 std::optional<NodeId> time);

/// Q_a = [forces] - dR/dy^a over the inputs `y`, shape (r); zeros where the model has none.
[[nodiscard]] std::vector<NodeId> generalized_forces(Graph& graph, Lowering& lower, const Model& model,
                                                     const std::vector<NodeId>& y);

/// Binds `name` unless the model declares it as a symbol.
void bind_undeclared(Binding& binding, const Model& model, const std::string& name, NodeId node);

} // namespace lagen
