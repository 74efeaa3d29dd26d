// SPDX-License-Identifier: GPL-2.0-or-later
/// Decides residuals, each distinct node once.
#pragma once

#include "proof/decide.hpp"

#include <map>
#include <memory>

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

} // namespace lagen
