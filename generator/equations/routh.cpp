// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/routh.hpp"

#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"

namespace lagen {

RouthianText routhian_text(const Model& model, const System& system, Graph& graph, const Routhian& routhian)
{
    SymbolicModel symbolic(model, system.written.algebroid, {});
    const auto shown = [&](NodeId node) { return symbolic.shortest(symbolic.lower(to_tree(graph, node))); };
    RouthianText text{shown(routhian.value), {}, {}};
    std::vector<NodeId> y;
    for (const std::size_t k : routhian.cyclic) y.push_back(system.algebroid.y[k]);
    const std::vector<NodeId> momenta = gradient(graph, *system.lagrangian, y);
    for (std::size_t k = 0; k < y.size(); ++k) {
        text.velocities.push_back(shown(routhian.velocities[k]));
        text.momenta.push_back(shown(momenta[k]));
    }
    return text;
}

} // namespace lagen
