// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/carried_distribution.hpp"

#include "verify/distribution_rows.hpp"
#include "proof/rank.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// Are the sections of D' independent along phi? Least squares, and the rank of Phi on D, tell nothing where they are
/// not.
bool is_independent(MappedSystems& both, Judge& judge)
{
    if (both.moving.basis.empty()) return true;
    std::vector<std::string> names;
    for (std::size_t beta = 0; beta < both.to().velocities().size(); ++beta)
        names.push_back(both.target_velocity(beta));
    const Check check = independence(both.graph, both.moving.basis, std::move(names), judge);
    return check.decision.status == ProofStatus::proved && check.where.empty();
}

Check decide_onto(MappedSystems& both, Judge& judge)
{
    Check onto{"constraint", {"Phi(D)"}, {}};
    if (!is_independent(both, judge)) {
        onto.decision.evidence =
            "the sections of the target are not shown to be independent at every point of the image";
        return onto;
    }
    const std::size_t wanted = both.to().velocities().size();
    const GenericRank rank =
        generic_rank(both.graph, both.moving.matrix, wanted, both.from().velocities().size(), judge.decider());
    if (rank.surjective && rank.where.empty()) {
        onto.decision = judge.decide(both.graph.constant(0));
    } else if (rank.rank && *rank.rank < wanted) {
        onto.decision.status = ProofStatus::refuted;
        onto.decision.residual = std::to_string(wanted - *rank.rank);
        onto.decision.evidence = fmt::format("Phi(D) has the rank {}, and D' has {}", *rank.rank, wanted);
    } else {
        onto.decision.evidence = "the rank of Phi on D is not decided at every point";
    }
    return onto;
}

} // namespace

CarriedDistribution decide_carried(MappedSystems& both, Judge& judge)
{
    CarriedDistribution carried;
    const std::vector<std::vector<NodeId>>& outside = both.moving.outside;
    for (std::size_t alpha = 0; alpha < outside.size(); ++alpha)
        for (std::size_t a = 0; a < outside[alpha].size(); ++a) {
            const NodeId residual = outside[alpha][a];
            if (both.graph.is_zero(residual)) continue;
            const std::string of = alpha + 1 < outside.size() ? both.velocity(alpha) : "drift";
            carried.checks.push_back(
                {"constraint", {"Phi(" + of + ")", both.target_section(a)}, judge.decide(residual)});
        }
    carried.checks.push_back(decide_onto(both, judge));
    carried.onto = carried.checks.back().decision.status == ProofStatus::proved;
    return carried;
}

} // namespace lagen
