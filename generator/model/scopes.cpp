// SPDX-License-Identifier: GPL-2.0-or-later
/// The scopes of a model: which names its expressions may use, and what is said of the others.
#include "model/model_reader.hpp"

#include "expression/derivative.hpp"
#include "model/families.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

SourceRange place_of(const Excerpt& key)
{
    return key.range(0, key.text.size());
}

/// The names in the body of a function that nobody calls: what shapes its parameters have, only a call can say.
class BodyNames {
  public:
    BodyNames(const ModelReader& reader, const Definition& definition) : reader_(reader), bound_(definition.parameters)
    {
    }

    /// Parsed trees are at most 1024 levels deep, so plain recursion is safe.
    void check(const Tree& tree)
    {
        const bool binds = tree->kind == TreeKind::sum_over || tree->kind == TreeKind::product_over;
        const bool is_name = tree->kind == TreeKind::name && !is_bound(tree->name);
        if (is_name || (tree->kind == TreeKind::apply && !is_call(*tree))) (void)reader_.arrows.close_array(tree, true);
        for (std::size_t k = 0; k < tree->arguments.size(); ++k) {
            const bool inside = binds && k == 2;
            if (inside) bound_.push_back(tree->name);
            check(tree->arguments[k]);
            if (inside) bound_.pop_back();
        }
    }

  private:
    [[nodiscard]] bool is_bound(const std::string& name) const
    {
        return std::find(bound_.begin(), bound_.end(), name) != bound_.end();
    }
    [[nodiscard]] bool is_call(const TreeNode& node) const
    {
        const std::vector<Definition>& all = reader_.model.definitions;
        const DerivativeEntry* derivative = find_derivative(node.name);
        if (derivative != nullptr && derivative->arity == node.arguments.size()) return true;
        return std::any_of(all.begin(), all.end(), [&](const Definition& each) {
            return each.name == node.name && !each.parameters.empty() &&
                   each.parameters.size() == node.arguments.size();
        });
    }

    const ModelReader& reader_;
    std::vector<std::string> bound_;
};

/// Unused definitions are read too: an error in one should not wait for its first use.
void require_sound_definitions(const ModelReader& reader)
{
    for (const Definition& definition : reader.model.definitions) {
        if (definition.parameters.empty()) {
            (void)reader.arrows.close_array(name(definition.name, definition.where), true);
        } else {
            BodyNames(reader, definition).check(definition.body);
        }
    }
}

/// Explains the names that observables, invariants and events may use and the model's other expressions may not.
void explain_observed(Scope& scope, const Model& model)
{
    for (const std::string& momentum : declared_names(model.fibre.momenta))
        scope.explain(momentum, "momenta stand in H, observables, invariants and events only");
    if (model.control)
        for (const std::string& control : declared_names(model.control->controls))
            scope.explain(control, "controls stand in sigma, cost, observables, invariants and events only");
    for (const std::string& input : declared_names(input_symbols(model)))
        scope.explain(input, "inputs stand in forces, sigma, [states], observables and events only");
    for (const std::string& state : declared_names(state_symbols(model)))
        scope.explain(state, "first-order states stand in forces, [states], observables, invariants and events only");
    scope.explain("energy", "the energy stands in observables, invariants and events only");
    scope.explain("hamiltonian", "the Hamiltonian stands in observables, invariants and events only");
}

/// Who misses a name of a state has parameters enough before the eyes.
void list_parameters_last(Scope& scope, const Model& model)
{
    scope.list_last("t");
    for (const std::string& parameter : declared_names(parameter_symbols(model))) scope.list_last(parameter);
    for (const Size& size : model.sizes) scope.list_last(size.name);
}

/// The coordinates of an arrow stand where no motion in continuous time is asked for.
void explain_arrows(Scope& scope, const Model& model)
{
    if (!model.groupoid) return;
    for (const auto* symbols : {&model.groupoid->element, &model.groupoid->next})
        for (const std::string& symbol : declared_names(*symbols))
            scope.explain(symbol, "coordinates of an arrow stand in the discrete Lagrangian, the action (the element "
                                  "alone), observables and columns of discrete scenes only");
    if (model.discrete)
        scope.explain(model.discrete->step.name,
                      fmt::format("the step stands in the discrete Lagrangian and in "
                                  "observables; everywhere where it is a parameter, {} = 0.1",
                                  model.discrete->step.name));
    if (!model.groupoid->has_targets())
        for (const std::string& each : declared_names(model.base.coordinates))
            scope.explain(each + "_next", "of a groupoid of kind \"action\" the target is computed by the action");
}

/// The observer's scope with what [discrete] L may use besides.
void build_arrows(ModelReader& reader)
{
    const Model& model = reader.model;
    reader.arrows = reader.observer;
    if (!model.groupoid) return;
    add_to_scope(reader.arrows, model, model.groupoid->element, FamilyRole::element);
    add_to_scope(reader.arrows, model, model.groupoid->next, FamilyRole::next);
    if (model.discrete && reader.names.find(model.discrete->step.name)->role == Role::step)
        reader.arrows.declare(model.discrete->step.name, model.discrete->step.where);
}

/// The fibre of a prolongation is X_a and V_a, or X_a and P_a: the other letter is a slip.
void explain_prolongation(Scope& scope, const AlgebroidBlock& block)
{
    if (block.kind != AlgebroidKind::prolongation) return;
    const char* wrong = block.dual ? "V_" : "P_";
    const char* right = block.dual ? "P_" : "V_";
    for (const std::string& inner : declared_names(block.of[0].fibre))
        if (scope.has_symbol(right + inner))
            scope.explain(wrong + inner,
                          fmt::format("bundle = \"{}\" has {}{}, bundle = \"{}\" has {}{}", block.dual ? "E*" : "E",
                                      right, inner, block.dual ? "E" : "E*", wrong, inner));
}

} // namespace

void refuse_inputs_in(const Model& model, const std::vector<NamedTree>& invariants)
{
    const std::vector<Symbol> inputs = input_symbols(model);
    for (const NamedTree& invariant : invariants)
        for (const std::string& used : names_in(invariant.value))
            if (index_of(inputs, used) < inputs.size())
                throw ModelError(fmt::format("the invariant '{}' depends on the input '{}', which may change as it "
                                             "likes along a motion",
                                             invariant.name, used),
                                 invariant.where, "an observable may use it");
}

void build_scopes(ModelReader& reader)
{
    Model& model = reader.model;
    Scope& scope = model.scope;
    scope.declare("t", {});
    list_parameters_last(scope, model);
    add_to_scope(scope, model, parameter_symbols(model), FamilyRole::parameter);
    add_to_scope(scope, model, model.base.coordinates, FamilyRole::base);
    if (!has_constraints_alone(reader)) add_to_scope(scope, model, model.fibre.coordinates, FamilyRole::fibre);
    if (is_nonholonomic(model)) add_to_scope(scope, model, ambient_fibre(model), FamilyRole::ambient);
    for (const Definition& definition : model.definitions) scope.define(definition);
    for (const auto& [key, value] : reader.casimirs) scope.define(Definition{key.text, {}, value, place_of(key)});
    declare_arrows(reader);
    explain_arrows(scope, model);
    explain_observed(scope, model);
    read_algebroid(reader);
    explain_prolongation(scope, model.algebroid);
    reader.rates = coordinate_rates(model);

    std::set<std::string> used(reader.names.order().begin(), reader.names.order().end());
    std::vector<std::string> extra;
    const auto fresh = [&used](const std::string& name) { return used.insert(name).second; };
    std::vector<std::string> quantities{"energy", "hamiltonian"};
    if (is_nonholonomic(model)) quantities.emplace_back("moving_energy");
    for (const std::string& quantity : quantities)
        if (fresh(quantity)) extra.push_back(quantity);
    const bool lagrangian = fresh("lagrangian");
    if (lagrangian && !reader.lagrangian) extra.push_back("lagrangian");
    reader.mechanical = scope;
    add_to_scope(reader.mechanical, model, model.fibre.momenta, FamilyRole::momentum);
    if (model.control) add_to_scope(reader.mechanical, model, model.control->controls, FamilyRole::control);
    add_to_scope(reader.mechanical, model, input_symbols(model), FamilyRole::input);
    add_to_scope(reader.mechanical, model, state_symbols(model), FamilyRole::state);
    reader.observer = reader.mechanical.with(extra);
    for (const std::string& quantity : extra) reader.observer.define({rate_name(quantity), {}, nullptr, {}});
    explain_rates(reader.observer, reader.rates);
    if (lagrangian && reader.lagrangian) {
        reader.observer.define(Definition{"lagrangian", {}, reader.lagrangian, model.lagrangian_where});
    }
    define_cost(reader);
    for (const auto& [key, value] : reader.observables) {
        const Names::Entry* entry = reader.names.find(key.text);
        if (entry->role == Role::observable) reader.observer.define(Definition{key.text, {}, value, place_of(key)});
    }
    for (const auto& [key, value] : reader.invariants) {
        if (fresh(key.text)) reader.observer.define(Definition{key.text, {}, value, place_of(key)});
    }
    build_arrows(reader);
    if (!reader.is_probe) require_sound_definitions(reader);
}

} // namespace lagen
