// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/bind_parameters.hpp"

#include "graph/core/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

bool is_bound(const Model& model, const std::string& name)
{
    const auto is_it = [&](const Parameter& parameter) { return parameter.symbol.name == name; };
    const auto found = std::ranges::find_if(model.parameters, is_it);
    return found != model.parameters.end() && found->bound;
}

bool names_bound_alone(const Model& model, const Tree& condition)
{
    const std::vector<std::string> names = names_in(condition);
    return !names.empty() && std::ranges::all_of(names, [&](const std::string& name) { return is_bound(model, name); });
}

} // namespace

/// Every value lowered after those that it uses; the model has made sure that there is no cycle.
Binding parameter_values(Graph& graph, const Model& model)
{
    Binding known;
    while (known.size() < model.parameters.size()) {
        const std::size_t before = known.size();
        for (const Parameter& parameter : model.parameters) {
            const std::vector<std::string> uses = names_in(parameter.value);
            const bool ready = std::ranges::all_of(uses, [&](const std::string& use) { return known.contains(use); });
            if (!ready || known.contains(parameter.symbol.name)) continue;
            known[parameter.symbol.name] = Lowering(graph, known)(parameter.value);
        }
        if (known.size() == before) throw InternalError("parameters that depend on each other in a cycle");
    }
    return known;
}

void bind_parameters(Graph& graph, const Model& model)
{
    if (std::ranges::none_of(model.parameters, &Parameter::bound)) return;
    const Binding values = parameter_values(graph, model);
    for (const Parameter& parameter : model.parameters)
        if (parameter.bound) graph.bind(parameter.symbol.name, values.at(parameter.symbol.name));
}

void settle_domain(Model& model)
{
    std::erase_if(model.base.domain, [&](const Tree& condition) {
        if (!names_bound_alone(model, condition)) return false;
        Graph graph;
        const NodeId node[] = {Lowering(graph, parameter_values(graph, model))(condition)};
        if (evaluate<long double>(graph, node, {})[0] != 0) return true;
        throw ModelError(fmt::format("the bound parameters do not fulfil {}", to_text(condition)), condition->where,
                         "the domain is what the model holds for; bind other values");
    });
}

void bind_in_scene(Model& model, const Scene& scene)
{
    for (const NamedTree& entry : scene.parameters)
        for (Parameter& parameter : model.parameters)
            if (parameter.symbol.name == entry.name) parameter.value = entry.value;
    settle_domain(model);
}

void bind_all_in_scene(Model& model, const Scene& scene)
{
    for (Parameter& parameter : model.parameters) parameter.bound = true;
    bind_in_scene(model, scene);
}

} // namespace lagen
