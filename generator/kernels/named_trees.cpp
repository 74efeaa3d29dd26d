// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/named_trees.hpp"

#include "model/read_curve.hpp"

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

} // namespace lagen
