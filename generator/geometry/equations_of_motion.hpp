// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates along Lagrange's equations, kept polynomial where that is possible: momenta and energy have rates of their
/// own, so that only functions of y that are not written in them need W^-1.
///   pdot_a = rho_a(L) - p_c C^c_ab y^b,   dE/dt = -dL/dt - p_c C^c_ab y^a y^b,   W ydot = pdot - (d2L/dydx) xdot -
///   d2L/dydt
#pragma once

#include "geometry/fibre_hessian.hpp"
#include "model/model.hpp"

#include <optional>

namespace lagen {

/// A rate, or why there is none.
struct Rate {
    std::optional<NodeId> value;
    std::string obstacle;
};

class EquationsOfMotion {
  public:
    /// `hessian` null: no Lagrangian. `time` is absent where the model declares a symbol t of its own.
    EquationsOfMotion(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian* hessian,
                      std::optional<NodeId> time);

    /// Stand-ins for momenta, `energy` and `lagrangian` (unless the model declares these names), to lower claims with.
    [[nodiscard]] Binding names(const Model& model) const;

    /// df/dt of a node that may contain the stand-ins; the result is free of them.
    [[nodiscard]] Rate rate(NodeId f);

    /// f with momenta and energy written out in x, y, t.
    [[nodiscard]] NodeId in_states(NodeId f) { return without_stand_ins({f})[0]; }

  private:
    [[nodiscard]] std::vector<NodeId> without_stand_ins(const std::vector<NodeId>& nodes);
    [[nodiscard]] std::optional<NodeId> along_accelerations(const std::vector<NodeId>& f_y, std::string& obstacle);

    Graph& graph_;
    const LoweredAlgebroid& algebroid_;
    const FibreHessian* hessian_;
    std::optional<NodeId> time_;
    std::vector<NodeId> xdot_, pdot_, force_; ///< force_: W ydot
    std::vector<NodeId> momentum_names_;
    NodeId energy_name_ = 0, energy_ = 0, energy_rate_ = 0;
};

} // namespace lagen
