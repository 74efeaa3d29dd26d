// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/at_values.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

std::optional<ProofSetting> replaced(Graph& graph, const ProofSetting& setting, const Replacements& values)
{
    ProofSetting result = setting;
    for (const auto& [input, value] : values) {
        std::erase(result.variables, input);
        std::erase(result.parameters, input);
    }
    for (std::vector<NodeId>* nodes : {&result.constraints, &result.domain, &result.defined}) {
        auto there = substitute_where_defined(graph, *nodes, values);
        if (!there) return std::nullopt;
        *nodes = std::move(*there);
    }
    return result;
}

std::optional<AtValues> at_values(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                                  const ProofBudget& budget, const Replacements& values)
{
    AtValues there{{}, hessian, nullptr};
    std::vector<NodeId> function = {hessian.lagrangian};
    const std::pair<std::vector<NodeId>*, const std::vector<NodeId>*> parts[] = {
        {&function, &function}, {&there.hessian.momenta, &hessian.momenta}, {&there.hessian.hessian, &hessian.hessian}};
    for (const auto& [to, from] : parts) {
        auto nodes = substitute_where_defined(graph, *from, values);
        if (!nodes) return std::nullopt;
        *to = std::move(*nodes);
    }
    auto here = replaced(graph, setting, values);
    if (!here) return std::nullopt;
    there.hessian.lagrangian = function[0];
    there.setting = std::move(*here);
    there.decider = ZeroDecider::make(graph, there.setting, budget);
    if (!there.decider) return std::nullopt;
    return there;
}

} // namespace lagen
