// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/jumps.hpp"

#include <fmt/format.h>

namespace lagen {

std::string jump_of(const Graph& graph, NodeId f, const ZeroDecider& decider)
{
    const NodeId roots[] = {f};
    for (const NodeId id : reachable(graph, roots)) {
        if (graph.op(id) != Op::atan2) continue;
        const NodeId v = graph.operands(id)[0];
        const NodeId u = graph.operands(id)[1];
        if (decider.proves_nonzero(v) || decider.proves_positive(u)) continue;
        return fmt::format("{} jumps by 2*pi where {} changes its sign and {} < 0", to_text(graph, id, 80),
                           to_text(graph, v, 60), to_text(graph, u, 60));
    }
    return {};
}

void respect_jumps(Decision& decision, const Graph& graph, NodeId f, const ZeroDecider& decider)
{
    if (decision.status != ProofStatus::proved) return;
    const std::string jump = jump_of(graph, f, decider);
    if (jump.empty()) return;
    decision.status = ProofStatus::undecided;
    decision.evidence = "its rate vanishes, but " + jump;
}

} // namespace lagen
