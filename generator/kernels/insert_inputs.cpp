// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/insert_inputs.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

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
    if (system.control) insert(system.control->sigma);
    system.inputs.clear();
    system.input_values.clear();
    return system;
}

} // namespace lagen
