// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/model_trees.hpp"

#include <algorithm>
#include <set>

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

bool is_partial(const TreeNode& tree)
{
    if (tree.kind == TreeKind::divide) return true;
    if (tree.kind == TreeKind::power) {
        const Tree& exponent = tree.arguments[1];
        return exponent->kind != TreeKind::number || exponent->number.get_den() != 1 || sgn(exponent->number) < 0;
    }
    if (tree.kind != TreeKind::call) return false;
    switch (tree.function) {
    case Function::sqrt:
    case Function::log:
    case Function::tan:
    case Function::asin:
    case Function::acos:
    case Function::atan2: return true;
    default: return false;
    }
}

} // namespace

std::vector<Tree> partial_operations(const std::vector<Tree>& trees)
{
    std::vector<Tree> found;
    std::set<const TreeNode*> seen;
    std::vector<Tree> stack(trees.rbegin(), trees.rend());
    while (!stack.empty()) {
        const Tree tree = stack.back();
        stack.pop_back();
        if (tree == nullptr || !seen.insert(tree.get()).second) continue;
        if (is_partial(*tree)) found.push_back(tree);
        stack.insert(stack.end(), tree->arguments.begin(), tree->arguments.end());
    }
    return found;
}

std::vector<Tree> all_trees(const Model& model, const Algebroid& algebroid)
{
    std::vector<Tree> trees;
    for (const Definition& definition : model.definitions) append_definition(trees, model.observer, definition);
    trees.insert(trees.end(), algebroid.domain.begin(), algebroid.domain.end());
    trees.insert(trees.end(), algebroid.constraints.begin(), algebroid.constraints.end());
    for (const NamedTree& casimir : model.base.casimirs) trees.push_back(casimir.value);
    for (const AnchorValue& entry : algebroid.rho) trees.push_back(entry.value);
    for (const StructureValue& entry : algebroid.C) trees.push_back(entry.value);
    if (model.lagrangian) trees.push_back(model.lagrangian);
    for (const std::vector<NamedTree>* list : {&model.invariants, &model.observables})
        for (const NamedTree& entry : *list) trees.push_back(entry.value);
    for (const Scene& scene : model.scenes)
        for (const Event& event : scene.events) trees.push_back(event.when);
    return trees;
}

} // namespace lagen
