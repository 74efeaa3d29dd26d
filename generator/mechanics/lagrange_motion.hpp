// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates along Lagrange's equations, kept polynomial where that is possible: momenta and energy have rates of their
/// own, so that only functions of y that are not written in them need W^-1.
///   pdot_a = rho_a(L) - p_c C^c_ab y^b + Q_a,   dE/dt = Q_a y^a - dL/dt - p_c C^c_ab y^a y^b,
///   W ydot = pdot - (d2L/dydx) xdot - d2L/dydt
/// and along (N) of mechanics/nonholonomic.hpp.
#pragma once

#include "mechanics/equations_of_motion.hpp"
#include "mechanics/lagrange.hpp"

namespace lagen {

class LagrangeMotion : public EquationsOfMotion {
  public:
    /// `lagrangian` null: no Lagrangian. Keeps references.
    LagrangeMotion(Graph& graph, const System& system, const LagrangianNodes* lagrangian);

    /// Momenta, `energy`, `hamiltonian` and `lagrangian`; of a nonholonomic system Y and `moving_energy` too.
    [[nodiscard]] Binding names() const override;
    [[nodiscard]] Rate rate(NodeId f) override;
    [[nodiscard]] NodeId in_states(NodeId f) override { return without_stand_ins({f})[0]; }

  private:
    /// An energy with its stand-in, and its rate where that is free of accelerations.
    struct FollowedEnergy {
        NodeId name = 0, value = 0;
        std::optional<NodeId> rate;
    };
    void take_kinematics();
    [[nodiscard]] std::vector<NodeId> without_stand_ins(const std::vector<NodeId>& nodes);
    [[nodiscard]] std::optional<NodeId> along_accelerations(const std::vector<NodeId>& f_y, Rate& rate);

    Graph& graph_;
    const System& system_;
    const LagrangianNodes* lagrangian_;
    std::vector<NodeId> xdot_, pdot_, force_; ///< force_: W ydot
    std::vector<NodeId> momentum_names_;
    FollowedEnergy energy_, moving_energy_; ///< the second of a nonholonomic system
    Binding ambient_;                       ///< Y of a nonholonomic system
};

} // namespace lagen
