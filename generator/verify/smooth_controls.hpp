// SPDX-License-Identifier: GPL-2.0-or-later
/// Signs and smoothness of expressions in controls, where each control runs through its interval.
#pragma once

#include "mechanics/system.hpp"
#include "proof/decide.hpp"

#include <memory>

namespace lagen {

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

} // namespace lagen
