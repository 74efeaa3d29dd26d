// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/carried_states.hpp"

#include "model/families.hpp"
#include "model/form.hpp"
#include "model/read_curve.hpp"
#include "model/total_cost.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace lagen {

namespace {

/// The trees that are evaluated along every motion of the scene; without a scene those of a header.
std::vector<Tree> evaluated_trees(const Model& model, const Scene* scene)
{
    std::vector<Tree> trees;
    for (const ComponentEntry& force : model.forces) trees.push_back(force.value);
    for (const NamedTree& invariant : model.invariants) trees.push_back(invariant.value);
    for (const Scene& each : scene != nullptr ? std::span(scene, 1) : std::span<const Scene>(model.scenes))
        for (const Event& event : each.events) {
            trees.push_back(event.when);
            for (const NamedTree& value : event.jump) trees.push_back(value.value);
        }
    if (scene == nullptr) {
        for (const NamedTree& observable : model.observables) trees.push_back(observable.value);
        return trees;
    }
    if (scene->observe)
        for (const NamedTree& column : *scene->observe) trees.push_back(column.value);
    for (const NamedTree& coordinate : plot_coordinates(*scene)) trees.push_back(coordinate.value);
    for (const NamedTree& input : scene->inputs) trees.push_back(input.value);
    if (scene->time_scale != nullptr) trees.push_back(scene->time_scale);
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
    const bool chosen = scene != nullptr && scene->observe;
    for (std::size_t k = 0; k < model.states.size() && !chosen; ++k)
        if (!is_total_cost(model, k)) carried.push_back(k);
    if (carried.size() == model.states.size()) return carried;
    const std::vector<Symbol> symbols = state_symbols(model);
    std::vector<Tree> open = evaluated_trees(model, scene);
    while (!open.empty()) {
        const Tree tree = std::move(open.back());
        open.pop_back();
        for (const std::string& name : names_in(tree)) {
            const std::size_t used = index_of(symbols, name);
            if (used == symbols.size() || std::ranges::find(carried, used) != carried.end()) continue;
            if (is_total_cost(model, used) && !is_form(form, FormKind::pontryagin)) continue;
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
