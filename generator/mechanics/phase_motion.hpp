// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations on E*, Hamilton's (mechanics/hamilton.hpp) and Pontryagin's (mechanics/pontryagin.hpp), and rates along
/// them:
///   xdot^i = rho^i_a y^a,   mudot_a = -(rho_a(H) + mu_c C^c_ab y^b) + Q_a,   dH/dt = Q_a y^a + (dH/dt)_explicit
/// with y = dH/dmu, or y = sigma(x, u) where u solves dH/du = 0 or stands at a bound.
#pragma once

#include "mechanics/equations_of_motion.hpp"
#include "mechanics/momentum_balance.hpp"

namespace lagen {

/// Nodes of a system on E*; everything is over the inputs x, mu, t and, where they are not solved for, u.
struct PhaseSystem {
    NodeId hamiltonian = 0;
    NodeId lagrangian = 0;           ///< mu_a y^a - H
    std::vector<NodeId> mu;          ///< inputs, shape (r)
    std::vector<NodeId> y;           ///< shape (r)
    std::vector<NodeId> xdot, mudot; ///< shapes (n), (r)
    NodeId energy_rate = 0;          ///< dH/dt
    Binding more;                    ///< names of a nonholonomic system, which win over those of H
    Replacements found;              ///< controls with their values on extremals
    std::vector<NamedNode> divisors; ///< determinants that these values divide by
    std::vector<NodeId> open;        ///< controls that are not solved for
    std::string obstacle;            ///< why
};

/// The rates that follow from f = -H, y and Q.
[[nodiscard]] PhaseSystem phase_system(Graph& graph, const System& system, const MomentumBalance& balance,
                                       NodeId hamiltonian, NodeId lagrangian);

/// What fibre coordinates, momenta and controls stand for, and, where the system declares no such names, `energy`,
/// `hamiltonian` (both `energy`) and `lagrangian`.
[[nodiscard]] Binding phase_names(const System& system, const PhaseSystem& phase, NodeId energy);

class PhaseMotion : public EquationsOfMotion {
  public:
    /// Keeps a reference to `system`.
    PhaseMotion(Graph& graph, const System& system, PhaseSystem phase);

    /// Those of `phase_names`, with a stand-in for the energy.
    [[nodiscard]] Binding names() const override { return phase_names(system_, phase_, energy_name_); }
    [[nodiscard]] Rate rate(NodeId f) override;
    [[nodiscard]] NodeId in_states(NodeId f) override;

  private:
    [[nodiscard]] bool has_open_control(NodeId f) const;

    Graph& graph_;
    const System& system_;
    PhaseSystem phase_;
    NodeId energy_name_;
};

} // namespace lagen
