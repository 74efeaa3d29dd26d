// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/routh.hpp"

#include "equations/symbolic_model.hpp"
#include "graph/core/lower.hpp"

namespace lagen {

RouthianText routhian_text(const Model& model, const System& system, const Graph& graph, const Routhian& routhian)
{
    SymbolicModel symbolic(model, system.written.algebroid, {});
    const auto shown = [&](NodeId node) { return symbolic.shortest(symbolic.lower(to_tree(graph, node))); };
    RouthianText text{shown(routhian.value), {}, {}};
    for (const NodeId each : routhian.velocities) text.velocities.push_back(shown(each));
    for (const NodeId each : routhian.momenta) text.momenta.push_back(shown(each));
    return text;
}

} // namespace lagen
