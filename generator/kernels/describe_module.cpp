// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/describe_module.hpp"

#include "graph/kernel.hpp"
#include "model/families.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

// The matrices of [reconstruct] among the lanes of a form.

/// The matrices whose entries are among `states`, numbers of first-order states that stand behind `before` other lanes.
std::vector<GroupLanes> group_lanes(const Model& model, const std::vector<std::size_t>& states, std::size_t before)
{
    std::vector<GroupLanes> matrices;
    for (const Reconstruction& g : model.reconstructions) {
        const auto place = std::ranges::find(states, g.first);
        if (place == states.end()) continue;
        GroupLanes& lanes = matrices.emplace_back();
        lanes.name = g.name;
        lanes.group = g.group;
        lanes.first = before + static_cast<std::size_t>(place - states.begin());
        lanes.size = g.size;
        for (std::size_t c = 0; c < g.generators.size(); ++c)
            for (std::size_t k = 0; k < g.size * g.size; ++k)
                if (const Rational& value = g.generators[c].entries[k]->number; value != 0)
                    lanes.generators.push_back({c, k / g.size, k % g.size, value});
    }
    return matrices;
}

Quantity quantity(const Symbol& symbol, NodeId input)
{
    return {symbol.name, symbol.text, symbol.unit, input};
}

/// Parameters of the model, and its inputs; the step of a discrete motion is a parameter too where it is a symbol of
/// its own.
void describe_parameters(KernelModule& module, const Model& model, const System& system, const Formulation& form)
{
    Graph& graph = *module.graph;
    for (const Parameter& parameter : model.parameters) {
        const std::string& name = parameter.symbol.name;
        const NodeId node = graph.input(name);
        if (parameter.bound)
            module.constants.push_back(fmt::format("{} = {}", name, to_text(graph, node)));
        else
            module.parameters.push_back(quantity(parameter.symbol, node));
    }
    for (const auto& [parameter, value] : system.parameter_values) module.parameter_defaults.push_back(value);
    if (!form.step) {
        for (std::size_t k = 0; k < form.inputs.size(); ++k)
            module.inputs.push_back(quantity(model.inputs[k].symbol, form.inputs[k]));
        for (const auto& [input, value] : system.input_values) module.input_defaults.push_back(value);
        return;
    }
    if (!has_own_step(model)) return;
    module.parameters.push_back(quantity(model.discrete->step, system.discrete->step));
    module.parameter_defaults.push_back(graph.constant(0));
}

/// The numbers of the first-order states that the form carries.
std::vector<std::size_t> numbers_of(const System& system, const Formulation& form)
{
    std::vector<std::size_t> numbers;
    for (const NodeId state : form.states)
        numbers.push_back(static_cast<std::size_t>(std::ranges::find(system.states, state) - system.states.begin()));
    return numbers;
}

std::vector<LaneGroup> lane_groups(const Model& model, const System& system, const Formulation& form)
{
    if (!form.groups.empty()) return form.groups;
    LaneGroup base{"Base", "base", "Base coordinates, the first lanes of State.", {}};
    for (std::size_t i = 0; i < form.x.size(); ++i)
        base.lanes.push_back(quantity(model.base.coordinates[i], form.x[i]));
    LaneGroup fibre{form.form->lane_group, "fibre", "The other lanes of State.", {}};
    const std::vector<Symbol>& symbols = form.form->momenta ? model.fibre.momenta : model.fibre.coordinates;
    for (std::size_t a = 0; a < form.lanes.size(); ++a) fibre.lanes.push_back(quantity(symbols[a], form.lanes[a]));
    std::vector<LaneGroup> groups{std::move(base), std::move(fibre)};
    if (!form.states.empty())
        groups.push_back({"States", "states", "First-order states, the last lanes of State.", {}});
    for (const std::size_t k : numbers_of(system, form))
        groups.back().lanes.push_back(quantity(model.states[k].symbol, system.states[k]));
    return groups;
}

} // namespace

KernelModule describe_module(std::shared_ptr<Graph> graph, const Model& model, const System& system,
                             const Formulation& form)
{
    KernelModule module;
    module.model = model.name;
    module.form = form.form->name;
    module.name = model.name + form.form->suffix;
    module.title = model.title;
    module.regenerate = fmt::format("lagen generate {}.toml", model.name);
    module.graph = std::move(graph);
    module.time = form.time;
    module.kind = form.step ? ModuleKind::step : ModuleKind::vector_field;
    module.groups = lane_groups(model, system, form);
    module.matrices = group_lanes(model, numbers_of(system, form), form.x.size() + form.lanes.size());
    module.step = form.step;
    module.implicit = form.implicit;
    module.parameter_conditions = form.parameter_conditions;
    describe_parameters(module, model, system, form);
    return module;
}

} // namespace lagen
