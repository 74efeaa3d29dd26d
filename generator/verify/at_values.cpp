// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/at_values.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

std::optional<AtValues> at_values(Graph& graph, const std::vector<NodeId>& nodes, const ProofSetting& setting,
                                  const ProofBudget& budget, const Replacements& values)
{
    AtValues there{nodes, setting, nullptr};
    for (const auto& [input, value] : values) {
        std::erase(there.setting.variables, input);
        std::erase(there.setting.parameters, input);
    }
    for (std::vector<NodeId>* each :
         {&there.nodes, &there.setting.constraints, &there.setting.domain, &there.setting.defined}) {
        auto moved = substitute_where_defined(graph, *each, values);
        if (!moved) return std::nullopt;
        *each = std::move(*moved);
    }
    there.decider = ZeroDecider::make(graph, there.setting, budget);
    if (!there.decider) return std::nullopt;
    return there;
}

std::optional<HessianAtValues> at_values(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                                         const ProofBudget& budget, const Replacements& values)
{
    std::vector<NodeId> nodes{hessian.lagrangian};
    nodes.insert(nodes.end(), hessian.momenta.begin(), hessian.momenta.end());
    nodes.insert(nodes.end(), hessian.hessian.begin(), hessian.hessian.end());
    std::optional<AtValues> there = at_values(graph, nodes, setting, budget, values);
    if (!there) return std::nullopt;
    HessianAtValues result{std::move(*there), hessian};
    auto next = result.nodes.begin();
    result.hessian.lagrangian = *next++;
    for (std::vector<NodeId>* part : {&result.hessian.momenta, &result.hessian.hessian})
        for (NodeId& node : *part) node = *next++;
    return result;
}

} // namespace lagen
