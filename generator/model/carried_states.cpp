// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/carried_states.hpp"

#include "model/families.hpp"
#include "model/form.hpp"
#include "model/read_curve.hpp"

#include <algorithm>
#include <numeric>

namespace lagen {

namespace {

/// What is evaluated along every motion of the scene.
std::vector<Tree> evaluated_trees(const Model& model, const Scene& scene)
{
    std::vector<Tree> trees;
    for (const ComponentEntry& force : model.forces) trees.push_back(force.value);
    for (const NamedTree& invariant : model.invariants) trees.push_back(invariant.value);
    for (const NamedTree& column : *scene.observe) trees.push_back(column.value);
    for (const NamedTree& coordinate : plot_coordinates(scene)) trees.push_back(coordinate.value);
    for (const Event& event : scene.events) trees.push_back(event.when);
    for (const NamedTree& input : scene.inputs) trees.push_back(input.value);
    if (scene.time_scale != nullptr) trees.push_back(scene.time_scale);
    return trees;
}

/// A state alone, or all entries of a matrix: it stays on its group as a whole.
std::vector<std::size_t> together(const Model& model, std::size_t state)
{
    for (const Reconstruction& g : model.reconstructions) {
        if (!g.holds(state)) continue;
        std::vector<std::size_t> entries(g.size * g.size);
        std::iota(entries.begin(), entries.end(), g.first);
        return entries;
    }
    return {state};
}

} // namespace

std::vector<std::size_t> carried_states(const Model& model, const std::string& form, const Scene* scene)
{
    std::vector<std::size_t> carried;
    if (form_named(form).steps) return carried;
    if (scene == nullptr || !scene->observe) {
        carried.resize(model.states.size());
        std::iota(carried.begin(), carried.end(), std::size_t{0});
        return carried;
    }
    if (model.states.empty()) return carried;
    const std::vector<Symbol> symbols = state_symbols(model);
    std::vector<Tree> open = evaluated_trees(model, *scene);
    while (!open.empty()) {
        const Tree tree = std::move(open.back());
        open.pop_back();
        for (const std::string& name : names_in(tree)) {
            const std::size_t used = index_of(symbols, name);
            if (used == symbols.size() || std::ranges::find(carried, used) != carried.end()) continue;
            for (const std::size_t k : together(model, used)) {
                carried.push_back(k);
                open.push_back(model.states[k].rate);
            }
        }
    }
    std::ranges::sort(carried);
    return carried;
}

bool uses_other_states(const Model& model, const Tree& tree, const std::vector<std::size_t>& carried)
{
    if (carried.size() == model.states.size()) return false;
    const std::vector<Symbol> symbols = state_symbols(model);
    return std::ranges::any_of(names_in(tree), [&](const std::string& name) {
        const std::size_t k = index_of(symbols, name);
        return k < symbols.size() && std::ranges::find(carried, k) == carried.end();
    });
}

} // namespace lagen
