// SPDX-License-Identifier: GPL-2.0-or-later
/// A lane whose rate vanishes, and that no jump changes, is a constant of the start.
#include "least/reduction.hpp"

namespace lagen {

bool hold_constants(Reduction& reduction)
{
    std::vector<NodeId> held;
    for (std::size_t i = 0; i < reduction.system.lanes.size(); ++i) {
        const NodeId lane = reduction.system.lanes[i];
        const auto needed = reduction.prover.vanishing({reduction.system.rates[i]});
        if (!needed || !reduction.survives_jumps(lane)) continue;
        reduction.prover.bind(*needed);
        reduction.steps.push_back({.rule = "constant", .lane = reduction.name_of(lane), .relations = *needed});
        held.push_back(lane);
    }
    reduction.hold(held);
    return !held.empty();
}

} // namespace lagen
