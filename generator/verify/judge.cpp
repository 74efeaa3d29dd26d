// SPDX-License-Identifier: GPL-2.0-or-later
/// The memory of decisions: hash-consing makes equal residuals the same node.
#include "verify/judge.hpp"

#include "verify/witness_point.hpp"

namespace lagen {

Judge::Judge(const Graph& graph, ProofSetting setting, const ProofBudget& budget)
    : graph_(graph), setting_(std::move(setting)), decider_(std::make_unique<ZeroDecider>(graph, setting_, budget))
{
}

Decision Judge::decide_anew(NodeId residual) const
{
    Decision decision = decider_->decide(residual);
    show_concerned(graph_, setting_, residual, decision);
    return decision;
}

const Decision& Judge::decide(NodeId residual)
{
    const auto known = decisions_.find(residual);
    if (known != decisions_.end()) return known->second;
    return decisions_.emplace(residual, decide_anew(residual)).first->second;
}

} // namespace lagen
