// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/model_trees.hpp"

#include "model/scene_form.hpp"

#include <algorithm>

namespace lagen {
namespace {

void append_definition(std::vector<Tree>& trees, const Scope& scope, const Definition& definition)
{
    // A parameter called like a coordinate is not that coordinate, which may be subject to constraints.
    const auto& parameters = definition.parameters;
    if (std::any_of(parameters.begin(), parameters.end(),
                    [&](const std::string& parameter) { return scope.has_symbol(parameter); }))
        return;
    try {
        const Scope inner = parameters.empty() ? scope : scope.with(parameters);
        const Tree tree = parameters.empty() ? name(definition.name, definition.where) : definition.body;
        trees.push_back(inner.close(tree, true));
    } catch (const ModelError&) {
        return; // a vector, or a function of one
    }
}

/// Domain, constraints, Casimirs, rho, C, L, R and forces.
void append_built(std::vector<Tree>& trees, const Model& model, const WrittenAlgebroid& algebroid)
{
    trees.insert(trees.end(), algebroid.domain.begin(), algebroid.domain.end());
    trees.insert(trees.end(), algebroid.constraints.begin(), algebroid.constraints.end());
    for (const NamedTree& casimir : model.base.casimirs) trees.push_back(casimir.value);
    for (const AnchorValue& entry : algebroid.rho) trees.push_back(entry.value);
    for (const StructureValue& entry : algebroid.C) trees.push_back(entry.value);
    trees.insert(trees.end(), model.rates.begin(), model.rates.end());
    for (const Tree& tree : {model.lagrangian, model.dissipation})
        if (tree) trees.push_back(tree);
    for (const ComponentEntry& force : model.forces) trees.push_back(force.value);
}

/// What the file gives, the tables inside it included.
void append_block(std::vector<Tree>& trees, const AlgebroidBlock& block)
{
    for (const AnchorEntry& entry : block.anchor) trees.push_back(entry.value);
    for (const BracketEntry& entry : block.bracket) trees.push_back(entry.value);
    for (const ConnectionEntry& entry : block.connection) trees.push_back(entry.value);
    for (const SectionEntry& entry : block.sections) trees.push_back(entry.value);
    for (const SectionEntry& entry : block.drift) trees.push_back(entry.value);
    trees.insert(trees.end(), block.constraints.begin(), block.constraints.end());
    for (const ArrayValue& matrix : block.representation)
        trees.insert(trees.end(), matrix.entries.begin(), matrix.entries.end());
    for (const AlgebroidBlock& inner : block.of) append_block(trees, inner);
}

} // namespace

std::vector<Tree> phase_trees(const Model& model)
{
    std::vector<Tree> trees;
    if (model.hamiltonian) trees.push_back(model.hamiltonian);
    if (!model.control) return trees;
    for (const ComponentEntry& entry : model.control->sigma) trees.push_back(entry.value);
    trees.push_back(model.control->cost);
    for (const ControlBound& bound : model.control->bounds)
        for (const Tree& end : {bound.lower, bound.upper})
            if (end) trees.push_back(end);
    if (model.control->boundary && model.control->boundary->terminal_cost)
        trees.push_back(model.control->boundary->terminal_cost);
    return trees;
}

std::vector<Tree> structure_trees(const Model& model, const WrittenAlgebroid& algebroid)
{
    std::vector<Tree> trees;
    append_built(trees, model, algebroid);
    append_block(trees, model.algebroid);
    const std::vector<Tree> phase = phase_trees(model);
    trees.insert(trees.end(), phase.begin(), phase.end());
    return trees;
}

std::vector<Tree> all_trees(const Model& model, const WrittenAlgebroid& algebroid)
{
    std::vector<Tree> trees;
    for (const Definition& definition : model.definitions) append_definition(trees, model.observer, definition);
    append_built(trees, model, algebroid);
    for (const FirstOrderState& state : model.states) trees.push_back(state.rate);
    for (const std::vector<NamedTree>* list : {&model.invariants, &model.observables})
        for (const NamedTree& entry : *list)
            if (has_value(model, entry.value, entry_of(FormKind::pontryagin).name)) trees.push_back(entry.value);
    for (const Scene& scene : model.scenes) {
        for (const Event& event : scene.events) {
            trees.push_back(event.when);
            for (const NamedTree& each : event.jump) trees.push_back(each.value);
        }
        for (const NamedTree& input : scene.inputs) trees.push_back(input.value);
        if (scene.time_scale != nullptr) trees.push_back(scene.time_scale);
    }
    return trees;
}

} // namespace lagen
