// SPDX-License-Identifier: GPL-2.0-or-later
/// Decides residuals, each distinct node once.
#pragma once

#include "proof/decide.hpp"
#include "proof/enclosure.hpp"

#include <map>
#include <memory>
#include <set>

namespace lagen {

class Judge {
  public:
    /// Throws TriangularityError.
    Judge(const Graph& graph, ProofSetting setting, const ProofBudget& budget);

    [[nodiscard]] const Decision& decide(NodeId residual);
    /// A decision from elsewhere, for when the residual is asked about.
    void remember(NodeId residual, Decision decision) { decisions_.insert_or_assign(residual, std::move(decision)); }
    [[nodiscard]] const ZeroDecider& decider() const { return *decider_; }
    [[nodiscard]] const ProofSetting& setting() const { return setting_; }

  private:
    [[nodiscard]] Decision decide_anew(NodeId residual) const;

    const Graph& graph_;
    ProofSetting setting_;
    std::unique_ptr<ZeroDecider> decider_;
    std::map<NodeId, Decision> decisions_;
};

// The point of a witness, to evaluate other expressions at.

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
    /// Enclosures of nodes over the inputs of the point.
    [[nodiscard]] std::vector<proof::Ball> enclose(const std::vector<NodeId>& nodes) const;
    /// Operations carried out so far.
    [[nodiscard]] std::size_t effort() const { return effort_; }

  private:
    const Graph& graph_;
    proof::BallInputs balls_;
    std::size_t effort_ = 0;
};

} // namespace lagen
