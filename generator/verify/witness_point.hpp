// SPDX-License-Identifier: GPL-2.0-or-later
/// The point of a witness, to evaluate other expressions at.
#pragma once

#include "proof/decide.hpp"
#include "proof/enclosure.hpp"

#include <set>

namespace lagen {

/// The names of the inputs that nodes depend on.
[[nodiscard]] std::set<std::string> input_names(const Graph& graph, const std::vector<NodeId>& nodes);

/// What of a point something in these inputs is about: their values, and those of what a constraint ties to them.
[[nodiscard]] NamedPoint concerned(const Graph& graph, const ProofSetting& setting, std::set<std::string> names,
                                   const NamedPoint& point);

/// Leaves in the witness of a decision, where it has one, what the residual is about; the rest stays in `whole`.
void show_concerned(const Graph& graph, const ProofSetting& setting, NodeId residual, Decision& decision);

class WitnessPoint {
  public:
    WitnessPoint(Graph& graph, const NamedPoint& point);

    /// False where the value is certainly not zero at the point.
    [[nodiscard]] bool may_vanish(NodeId node);
    /// Operations carried out so far.
    [[nodiscard]] std::size_t effort() const { return effort_; }

  private:
    const Graph& graph_;
    proof::BallInputs balls_;
    std::size_t effort_ = 0;
};

} // namespace lagen
