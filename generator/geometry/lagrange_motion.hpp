// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates along Lagrange's equations, kept polynomial where that is possible: momenta and energy have rates of their
/// own, so that only functions of y that are not written in them need W^-1.
///   pdot_a = rho_a(L) - p_c C^c_ab y^b + Q_a,   dE/dt = Q_a y^a - dL/dt - p_c C^c_ab y^a y^b,
///   W ydot = pdot - (d2L/dydx) xdot - d2L/dydt
#pragma once

#include "geometry/equations_of_motion.hpp"
#include "geometry/fibre_hessian.hpp"

namespace lagen {

class LagrangeMotion : public EquationsOfMotion {
  public:
    /// `hessian` null: no Lagrangian. `forces`: Q_a, shape (r). `time` is absent where the model declares a symbol t of
    /// its own.
    LagrangeMotion(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian* hessian,
                   const std::vector<NodeId>& forces, std::optional<NodeId> time);

    /// Momenta, `energy`, `hamiltonian` and `lagrangian`.
    [[nodiscard]] Binding names(const Model& model) const override;
    [[nodiscard]] Rate rate(NodeId f) override;
    [[nodiscard]] NodeId in_states(NodeId f) override { return without_stand_ins({f})[0]; }

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
