// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/cancelled_time.hpp"

#include "graph/calculus/differentiate.hpp"
#include "proof/decide.hpp"

namespace lagen {

NodeId without_cancelled_time(Graph& graph, const System& system, NodeId f)
{
    const NodeId only[] = {f};
    if (!depends_on_any(graph, only, std::vector{system.time})) return f;
    const auto at_start = substitute_where_defined(graph, only, Replacements{{system.time, graph.constant(0)}});
    if (!at_start) return f;
    ProofSetting setting; // constraints are left out: they need not be triangular yet
    for (const auto* inputs : {&system.algebroid.x, &system.algebroid.y, &system.mu, &system.inputs, &system.states})
        setting.variables.insert(setting.variables.end(), inputs->begin(), inputs->end());
    setting.variables.push_back(system.time);
    setting.parameters = system.parameters;
    setting.domain = system.domain;
    setting.defined = {f};
    const auto decider = ZeroDecider::make(graph, setting, {});
    const bool same = decider && decider->status(graph.subtract(f, (*at_start)[0])) == ProofStatus::proved;
    return same ? (*at_start)[0] : f;
}

} // namespace lagen
