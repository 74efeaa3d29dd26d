// SPDX-License-Identifier: GPL-2.0-or-later
/// What does not vanish along a motion: what its equations divide by, and what the domain keeps off zero.
///
/// Motions are where rho, C and L with the forces (or H, or the control problem) are defined as they are written, and
/// d2L/dy2 is regular.
#pragma once

#include "proof/decide.hpp"

#include <memory>
#include <set>

namespace lagen {

class MotionDivisors {
  public:
    /// `setting.defined`: what the equations of motion are made of, and nothing else.
    MotionDivisors(Graph& graph, const ProofSetting& setting, const ProofBudget& budget);

    /// The momenta dL/dy are defined all along a motion: roots of L that make one infinite where they vanish do not.
    void keep_momenta_finite(NodeId lagrangian, const std::vector<NodeId>& y);

    /// All along every motion; false means "not shown".
    [[nodiscard]] bool nonzero(NodeId f) const;
    [[nodiscard]] bool positive(NodeId f) const;
    [[nodiscard]] bool nonnegative(NodeId f) const { return decider_->proves_nonnegative(f); }
    [[nodiscard]] bool is_defined(NodeId f) const { return certain_.contains(f); }
    /// Does not become zero: what does not move is zero for the whole motion or never.
    [[nodiscard]] bool keeps_nonzero(NodeId f) const { return !moves(f) || nonzero(f); }
    /// Does it depend on anything but parameters?
    [[nodiscard]] bool moves(NodeId f) const;

  private:
    void collect(const std::vector<NodeId>& motion);
    void require_nonzero(NodeId divisor);
    [[nodiscard]] std::vector<NodeId> linear_roots(NodeId lagrangian, const std::vector<NodeId>& y) const;
    [[nodiscard]] bool is_smooth_but_for(NodeId root, NodeId lagrangian, const std::vector<NodeId>& y);

    Graph& graph_;
    std::vector<NodeId> variables_;
    std::unique_ptr<ZeroDecider> decider_;
    std::set<NodeId> certain_;  ///< defined all along a motion
    std::set<NodeId> divisors_; ///< nonzero there
};

} // namespace lagen
