// SPDX-License-Identifier: GPL-2.0-or-later
/// Do the controls of Pontryagin's equations maximise H = mu_a sigma^a(t, x, u) - cost(t, x, u)? Without bounds they
/// solve dH/du = 0: a maximum where H is smooth and d2H/du2 < 0 for all u, or on the convex set of u where alone it is
/// defined. With bounds lo <= u <= hi the maximum is the
/// root of dH/du, or the bound next to it, where H is separable, and smooth and strictly concave on the interval.
/// Angles (verify/angle_controls.hpp) have their maximum in closed form, and the other controls stand apart from
/// them.
///                                                              [Pontryagin, Boltyanskii, Gamkrelidze, Mishchenko 1962]
#pragma once

#include "mechanics/pontryagin.hpp"
#include "mechanics/system.hpp"
#include "proof/decide.hpp"
#include "verify/verify.hpp"

#include <memory>

namespace lagen {

/// Decides for all states of `setting`, all costates `mu` (inputs) and all parameters; `setting` is that of the whole
/// system.
[[nodiscard]] ControlMaximum decide_maximum(Graph& graph, const ControlProblem& control, const std::vector<NodeId>& mu,
                                            const ProofSetting& setting, const ProofBudget& budget);

/// Throws MathematicsError where the controls cannot be solved for in such a way that H may be largest.
void require_maximum(const std::string& model, const ControlMaximum& maximum);

// Signs and smoothness of expressions in controls, where each control runs through its interval.

/// Proofs with the bounds of the controls among the conditions of the domain.
class ControlProofs {
  public:
    /// `setting` is that of the model: what it says of the definedness of expressions in the controls is left out,
    /// since that is asked here.
    ControlProofs(Graph& graph, const ControlProblem& control, const ProofSetting& setting, const ProofBudget& budget);

    /// By exact algebra, or by certified enclosures on small pieces where the value depends on one control alone whose
    /// bounds are numbers. False means "not shown".
    [[nodiscard]] bool positive(NodeId value) const;
    [[nodiscard]] bool nonzero(NodeId value) const;
    [[nodiscard]] bool zero(NodeId value) const;

    [[nodiscard]] bool depends_on_controls(NodeId node) const;

    /// The first kink or jump among what `roots` need, as "abs(u), where u was not proved to keep its sign"; empty
    /// where there is none.
    [[nodiscard]] std::string kink_in(const std::vector<NodeId>& roots);
    /// The first operation of `roots` that was not proved to be defined and smooth for all admissible controls, as
    /// "u^2/log(u)"; empty where there is none.
    [[nodiscard]] std::string partial_in(const std::vector<NodeId>& roots);

    [[nodiscard]] const ZeroDecider& decider() const { return *decider_; }
    [[nodiscard]] const ProofSetting& setting() const { return setting_; }

  private:
    [[nodiscard]] bool positive_on_pieces(NodeId value) const;
    [[nodiscard]] bool is_smooth(NodeId node);

    Graph& graph_;
    const ControlProblem& control_;
    ProofSetting setting_;
    std::unique_ptr<ZeroDecider> decider_;
    mutable std::vector<bool> moves_; ///< with the controls, of the nodes asked about so far
};

// Controls that are angles: H = a + b cos u + c sin u, where a is free of u, and b and c are free of all controls. H
// is largest where cos u = b / sqrt(b^2 + c^2), sin u = c / sqrt(b^2 + c^2); where b = c = 0 it does not depend on u.

/// b and c of an angle.
struct AngleTerms {
    NodeId b, c;
};

/// The numbers of the controls that are proved to be angles, for all states, costates and parameters: without bounds,
/// d3H/du3 + dH/du = 0, what stands in `parts` is smooth for all u, and b and c hold no control as they are written. A
/// control that H does not depend on is none of them.
[[nodiscard]] std::vector<std::size_t> find_angles(Graph& graph, const ControlProblem& control,
                                                   const ControlHamiltonian& hamiltonian,
                                                   const std::vector<NodeId>& parts, const ProofSetting& setting,
                                                   const ProofBudget& budget);

/// Of an angle u with dH/du = `slope`: b = -d2H/du2 and c = dH/du at u = 0.
[[nodiscard]] AngleTerms angle_terms(Graph& graph, NodeId slope, NodeId u);

/// The numbers below `count` that are not in `angles` (ascending).
[[nodiscard]] std::vector<std::size_t> other_controls(std::size_t count, const std::vector<std::size_t>& angles);

/// The problem of the other controls: what stands apart from the angles is the same where they vanish.
[[nodiscard]] ControlProblem without_angles(Graph& graph, const ControlProblem& control,
                                            const std::vector<std::size_t>& angles);

} // namespace lagen
