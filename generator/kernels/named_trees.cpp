// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/named_trees.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "model/read_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace lagen {

std::vector<NamedTree> constraint_trees(const Model& model)
{
    std::vector<NamedTree> trees;
    for (const Tree& tree : model.base.constraints) trees.push_back({to_text(tree), tree, {}});
    return trees;
}

std::vector<NamedTree> observable_trees(const Model& model, const Scene* scene, const std::vector<std::string>& states,
                                        const std::vector<Quantity>& lanes)
{
    std::vector<NamedTree> trees = model.observables;
    if (scene == nullptr) return trees;
    std::vector<NamedTree> observed;
    if (scene->observe)
        observed = *scene->observe;
    else
        for (const std::string& state : states) observed.push_back({state, name(state), {}});
    for (NamedTree& coordinate : plot_coordinates(*scene)) observed.push_back(std::move(coordinate));
    for (const NamedTree& entry : observed) {
        const auto known = [&](const auto& other) { return other.name == entry.name; };
        if (std::ranges::none_of(trees, known) && std::ranges::none_of(lanes, known)) trees.push_back(entry);
    }
    return trees;
}

std::vector<NamedTree> event_trees(const Model& model, const Scene* scene)
{
    std::vector<NamedTree> trees;
    for (const Scene& each : scene != nullptr ? std::span(scene, 1) : std::span<const Scene>(model.scenes))
        for (const Event& event : each.events) {
            const auto found = std::ranges::find(trees, event.name, &NamedTree::name);
            if (found == trees.end())
                trees.push_back({event.name, event.when, {}});
            else if (!same_tree(found->value, event.when))
                trees.push_back({each.name + "." + event.name, event.when, {}});
        }
    return trees;
}

std::vector<NamedTree> given_inputs(const Model& model, const Scene* scene)
{
    std::vector<NamedTree> values;
    if (scene == nullptr || scene->input_table) return values;
    for (const Input& input : model.inputs) {
        const auto given = std::ranges::find(scene->inputs, input.symbol.name, &NamedTree::name);
        values.push_back(given != scene->inputs.end() ? *given
                                                      : NamedTree{input.symbol.name, input.value, input.symbol.where});
    }
    return values;
}

System insert_inputs(System system, const std::vector<NamedTree>& inputs)
{
    Graph& graph = system.graph;
    Lowering lower(graph);
    Replacements values;
    for (const NamedTree& input : inputs) values.emplace_back(graph.input(input.name), lower(input.value));
    const auto insert = [&](std::vector<NodeId>& nodes) {
        const auto inserted = substitute_where_defined(graph, nodes, values);
        if (!inserted)
            throw MathematicsError(
                fmt::format("model '{}' divides by zero where its inputs are those of this scene", system.name));
        nodes = *inserted;
    };
    insert(system.forces);
    insert(system.rates);
    if (system.control) insert(system.control->sigma);
    system.inputs.clear();
    system.input_values.clear();
    return system;
}

} // namespace lagen
