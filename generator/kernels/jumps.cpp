// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/jumps.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/lagrange.hpp"
#include "model/scene_form.hpp"

#include <algorithm>
#include <span>

namespace lagen {

namespace {

struct NamedJump {
    std::string name;
    const Event* event = nullptr;
};

bool same_jump(const Event& a, const Event& b)
{
    return std::ranges::equal(a.jump, b.jump, [](const NamedTree& x, const NamedTree& y) {
        return x.name == y.name && same_tree(x.value, y.value);
    });
}

bool sets_any(const Graph& graph, const Event& event, const std::vector<NodeId>& inputs)
{
    return std::ranges::any_of(inputs, [&](NodeId input) {
        return std::ranges::find(event.jump, graph.input_name(input), &NamedTree::name) != event.jump.end();
    });
}

std::vector<NamedJump> jumps_of(const Model& model, const Scene* scene, const std::string& form)
{
    std::vector<NamedJump> jumps;
    for (const Scene& each : scene != nullptr ? std::span(scene, 1) : std::span<const Scene>(model.scenes))
        for (const Event& event : each.events) {
            const auto has_none = [&](const NamedTree& entry) { return !has_value(model, entry.value, form); };
            if (event.jump.empty() || std::ranges::any_of(event.jump, has_none) || obstacle_to_jump(model, event, form))
                continue;
            const auto found = std::ranges::find(jumps, event.name, &NamedJump::name);
            if (found == jumps.end())
                jumps.push_back({event.name, &event});
            else if (!same_jump(*found->event, event))
                jumps.push_back({each.name + "." + event.name, &event});
        }
    return jumps;
}

std::vector<NodeId> state_behind(Graph& graph, const System& system, const Formulation& form, const Event& event)
{
    Lowering lower(graph, form.binding);
    const auto behind = [&](NodeId input, NodeId stays) {
        const auto set = std::ranges::find(event.jump, graph.input_name(input), &NamedTree::name);
        return set == event.jump.end() ? stays : lower(set->value);
    };
    std::vector<NodeId> lanes = state_of(form);
    for (NodeId& lane : lanes) lane = behind(lane, lane);
    const bool of_momenta = sets_any(graph, event, system.mu) || !system.lagrangian;
    const bool moves = sets_any(graph, event, form.x) || sets_any(graph, event, system.velocities());
    if (!form.form->momenta || of_momenta || !moves) return lanes;
    std::vector<std::pair<NodeId, NodeId>> places;
    for (std::size_t i = 0; i < form.x.size(); ++i) places.emplace_back(form.x[i], lanes[i]);
    for (const NodeId y : system.velocities()) places.emplace_back(y, behind(y, form.binding.at(graph.input_name(y))));
    const std::vector<NodeId> momenta = lagrangian_nodes(graph, system).fibre.momenta;
    const std::vector<NodeId> mu = substitute(graph, momenta, places);
    std::ranges::copy(mu, lanes.begin() + static_cast<std::ptrdiff_t>(form.x.size()));
    return lanes;
}

} // namespace

bool has_jumps(const Model& model, const Scene* scene, const EquationForm& form)
{
    return !jumps_of(model, scene, form.name).empty();
}

Kernel jumps_kernel(Graph& graph, const Model& model, const System& system, const Formulation& form, const Scene* scene)
{
    const std::vector<NamedJump> jumps = jumps_of(model, scene, form.form->name);
    const std::size_t lanes = state_of(form).size();
    std::vector<NodeId> values(lanes * jumps.size());
    std::vector<std::string> names;
    for (const NamedJump& jump : jumps) {
        const std::vector<NodeId> behind = state_behind(graph, system, form, *jump.event);
        for (std::size_t i = 0; i < lanes; ++i) values[i * jumps.size() + names.size()] = behind[i];
        names.push_back(jump.name);
    }
    Kernel kernel = table_kernel(form, "jumps", matrix(graph, "jumps", lanes, jumps.size(), values));
    kernel.outputs[0].entry_names = std::move(names);
    return kernel;
}

} // namespace lagen
