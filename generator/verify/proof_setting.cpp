// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/proof_setting.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/nonholonomic.hpp"
#include "proof/triangular.hpp"

#include <algorithm>

namespace lagen {
namespace {

void append_nodes(std::vector<NodeId>& nodes, const std::vector<NodeId>& more)
{
    nodes.insert(nodes.end(), more.begin(), more.end());
}

/// rho, C, L, H, forces, the control problem and Casimirs: they count where they are defined.
std::vector<NodeId> defined_nodes(const System& system)
{
    std::vector<NodeId> nodes = system.algebroid.entries();
    for (const std::optional<NodeId>& function : {system.lagrangian, system.hamiltonian})
        if (function) nodes.push_back(*function);
    append_nodes(nodes, system.forces);
    append_nodes(nodes, system.rates);
    if (system.distribution)
        for (const Section& section : system.distribution->sections)
            for (const ColumnEntry& entry : section) nodes.push_back(entry.value);
    if (system.control) {
        append_nodes(nodes, system.control->sigma);
        nodes.push_back(system.control->cost);
    }
    append_nodes(nodes, system.functions.casimirs);
    append_nodes(nodes, system.partial_parts);
    std::erase_if(nodes, [&](NodeId node) { return system.graph.is_constant(node); });
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

/// The first-order states of the model file, and of those that lagen adds itself what the file names: the others occur
/// in nothing that is decided.
std::vector<NodeId> named_states(const System& system)
{
    std::vector<NodeId> states;
    for (std::size_t k = 0; k < system.states.size(); ++k) {
        const NamedTree& written = system.written.states[k];
        const auto has_name = [&](const Tree& tree) { return mentions(tree, written.name); };
        if (written.where.file != nullptr || std::ranges::any_of(system.written.all, has_name) ||
            std::ranges::any_of(system.written.invariants, has_name, &NamedTree::value))
            states.push_back(system.states[k]);
    }
    return states;
}

} // namespace

ProofSetting proof_setting(Graph& graph, const System& system)
{
    ProofSetting setting;
    setting.variables = system.algebroid.x;
    append_nodes(setting.variables, system.velocities());
    if (system.hamiltonian || system.control) append_nodes(setting.variables, system.mu);
    if (system.control) append_nodes(setting.variables, system.control->u);
    append_nodes(setting.variables, system.inputs);
    append_nodes(setting.variables, named_states(system));
    setting.variables.push_back(system.time);
    setting.parameters = system.parameters;
    setting.constraints = system.functions.constraints;
    setting.domain = system.domain;
    if (system.is_level_set) setting.is_wider = proof::keep_triangular(graph, setting);
    setting.defined = defined_nodes(system);
    if (!system.distribution) return setting;
    const std::vector<NodeId> Y = constraint_hull(graph, system).Y;
    setting.defined = substitute(graph, setting.defined, replacements(system.algebroid.y, Y));
    std::erase_if(setting.defined, [&](NodeId node) { return graph.is_constant(node); });
    return setting;
}

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
