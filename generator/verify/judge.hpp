// SPDX-License-Identifier: GPL-2.0-or-later
/// Decides residuals, each distinct node once, and re-evaluates them where `check --verify` asks for it.
#pragma once

#include "proof/decide.hpp"

#include <map>
#include <memory>

namespace lagen {

/// Points of another seed than the decision's.
constexpr std::size_t reevaluation_seed = 1;

class Judge {
  public:
    /// `points`: regular points of a re-evaluation; 0: none. Throws TriangularityError.
    Judge(const Graph& graph, ProofSetting setting, std::size_t points, const ProofBudget& budget);

    [[nodiscard]] const Decision& decide(NodeId residual);
    /// A decision from elsewhere, for when the residual is asked about.
    void remember(NodeId residual, Decision decision) { decisions_.insert_or_assign(residual, std::move(decision)); }
    /// Absent without `points`. Once for each node.
    [[nodiscard]] std::optional<Reevaluation> reevaluate(NodeId residual);
    [[nodiscard]] const ZeroDecider& decider() const { return *decider_; }
    [[nodiscard]] const ProofSetting& setting() const { return setting_; }

  private:
    [[nodiscard]] Decision decide_anew(NodeId residual) const;

    const Graph& graph_;
    ProofSetting setting_;
    std::size_t points_;
    std::unique_ptr<ZeroDecider> decider_;
    std::unique_ptr<ZeroDecider> second_; ///< of the other seed; made when it is needed
    std::map<NodeId, Decision> decisions_;
    std::map<NodeId, Reevaluation> reevaluations_;
};

} // namespace lagen
