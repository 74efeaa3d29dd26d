// SPDX-License-Identifier: GPL-2.0-or-later
/// Divisions by an expression that is zero everywhere, also where algebra or the base constraints are needed to see it.
#pragma once

#include "expression/find_part.hpp"
#include "graph/core/lower.hpp"
#include "verify/witness_point.hpp"

#include <functional>
#include <set>

namespace lagen {

/// Looks through trees, in the order in which they are given; a divisor is looked at once.
class ZeroDivisors {
  public:
    /// `setting`: variables, parameters, constraints and domain; what must be `defined` is left out, since nothing is
    /// where a divisor vanishes.
    ZeroDivisors(Graph& graph, ProofSetting setting, const ProofBudget& budget);

    using Lower = std::function<NodeId(const Tree&)>;
    /// Throws ModelError at the first divisor (b of a / b, a of a^-n) that is proved to be zero.
    void refuse(const Tree& tree, const Lower& lower);

  private:
    [[nodiscard]] bool is_zero(NodeId node);

    Graph& graph_;
    ProofSetting setting_;
    ZeroDecider decider_;
    std::optional<WitnessPoint> point_; ///< where most divisors are seen not to vanish
    PartSearch seen_;
    std::set<NodeId> nonzero_; ///< looked at before
};

} // namespace lagen
