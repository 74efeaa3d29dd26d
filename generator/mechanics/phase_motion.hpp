// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates along Hamilton's and Pontryagin's equations on E*:
///   xdot^i = rho^i_a y^a,   mudot_a = -(rho_a(H) + mu_c C^c_ab y^b) + Q_a,   dH/dt = Q_a y^a + (dH/dt)_explicit
/// with y = dH/dmu, or y = sigma(x, u) where u solves dH/du = 0 for H = mu_a sigma^a - cost.
#pragma once

#include "mechanics/equations_of_motion.hpp"
#include "mechanics/hamilton.hpp"

namespace lagen {

/// Nodes of a system on E*; everything is over the inputs x, mu, t and, where they are not solved for, u.
struct PhaseSystem {
    NodeId hamiltonian = 0;
    NodeId lagrangian = 0;                        ///< mu_a y^a - H
    std::vector<NodeId> mu;                       ///< inputs, shape (r)
    std::vector<NodeId> y;                        ///< shape (r)
    std::vector<NodeId> xdot, mudot;              ///< shapes (n), (r)
    NodeId energy_rate = 0;                       ///< dH/dt
    std::vector<std::pair<NodeId, NodeId>> found; ///< controls with their values on extremals
    std::vector<NamedNode> divisors;              ///< determinants that these values divide by
    std::vector<NodeId> open;                     ///< controls that are not solved for
    std::string obstacle;                         ///< why
};

/// Hamilton's equations of a system that has H.
[[nodiscard]] PhaseSystem hamilton_system(Graph& graph, const System& system);

/// H = mu_a sigma^a - cost
[[nodiscard]] NodeId control_hamiltonian(Graph& graph, const ControlProblem& control, const std::vector<NodeId>& mu);

/// Pontryagin's equations of a control problem. Controls without bounds, in which dH/du is affine and d2H/du2 is
/// regular, are solved for.
[[nodiscard]] PhaseSystem pontryagin_system(Graph& graph, const System& system);

class PhaseMotion : public EquationsOfMotion {
  public:
    /// Keeps a reference to `system`.
    PhaseMotion(Graph& graph, const System& system, PhaseSystem phase);

    /// Fibre coordinates, controls, momenta, `energy`, `hamiltonian` and `lagrangian`.
    [[nodiscard]] Binding names() const override;
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
