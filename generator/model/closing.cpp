// SPDX-License-Identifier: GPL-2.0-or-later
/// The scopes of a model: which names its expressions may use, and what is said of the others. Closing expressions that
/// may use only some of the names, and tables of them.
#include "expression/derivative.hpp"
#include "expression/find_part.hpp"
#include "expression/name_hints.hpp"
#include "expression/rewrite.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/model_reader.hpp"
#include "model/read_values.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

Role role_of(const Names& names, const std::string& name)
{
    const Names::Entry* entry = names.find(name);
    return entry != nullptr ? entry->role : name == "t" ? Role::time : Role::built_in;
}

/// The first name in `trees` that plays none of `roles`.
Tree first_forbidden(const std::vector<Tree>& trees, const Names& names, Roles roles)
{
    return find_name(trees, [&](const std::string& name) { return !roles.has(role_of(names, name)); });
}

/// The roles that the model may have names of, in the order of the enumeration.
std::vector<Role> listed(const ModelReader& reader, Roles roles)
{
    std::vector<Role> out;
    for (Role role = Role::time; role <= Role::built_in; role = static_cast<Role>(static_cast<int>(role) + 1))
        if (roles.has(role) && (role != Role::ambient || is_nonholonomic(reader.model))) out.push_back(role);
    return out;
}

void require_roles(const std::vector<Tree>& closed, const ModelReader& reader, Roles roles, const SourceRange& where,
                   const std::string& what)
{
    const Tree bad = roles == any_role ? nullptr : first_forbidden(closed, reader.names, roles);
    if (bad == nullptr) return;
    throw complain::may_not_depend(
        what, fmt::format("{} ('{}')", role_text(role_of(reader.names, bad->name)), bad->name),
        bad->where.file ? bad->where : where, "allowed here: " + comma_list(listed(reader, roles), role_plural));
}

/// The names that an expression over `roles` may use: coordinates, controls and momenta, definitions over those, then
/// parameters and sizes.
std::vector<std::string> names_over(const ModelReader& reader, const Scope& scope, Roles roles)
{
    std::vector<std::string> known;
    const auto append = [&](Role role) {
        const std::vector<std::string> of_role = reader.names.of(role);
        known.insert(known.end(), of_role.begin(), of_role.end());
    };
    for (const Role role : listed(reader, roles))
        if (role != Role::parameter && role != Role::time) append(role);
    for (const Definition& definition : reader.model.definitions) {
        if (!definition.parameters.empty()) continue;
        try {
            const ArrayValue value = scope.close_array(name(definition.name));
            if (first_forbidden(value.entries, reader.names, roles) == nullptr) known.push_back(definition.name);
        } catch (const ModelError&) { // over names that are not legal here, or itself wrong
        }
    }
    if (roles.has(Role::time)) known.emplace_back("t");
    if (roles.has(Role::parameter)) append(Role::parameter);
    append(Role::size);
    return known;
}

/// The hint names what was meant, among the names that are legal here.
[[noreturn]] void refuse_unknown(const UnknownSymbol& error, const ModelReader& reader, const Scope& scope, Roles roles)
{
    if (error.is_explained() || roles == any_role) throw error;
    const auto refuse = [&error](const std::string& hint) {
        throw ModelError(error.diagnostic().message, error.diagnostic().where, hint);
    };
    const bool velocities = roles.has(Role::fibre) || roles.has(Role::ambient);
    const std::string meant = velocities                  ? hint_for_rate(error.name(), reader.rates)
                              : roles.has(Role::momentum) ? hint_for_momentum(error.name(), reader.rates)
                                                          : "";
    if (!meant.empty()) refuse(meant);
    if (velocities) throw error; // its hint lists all that may stand there
    const std::vector<std::string> known = names_over(reader, scope, roles);
    if (!known.empty()) refuse(hint_for_symbol(error.name(), known));
    const std::string& of_all = error.diagnostic().hint;
    if (of_all.starts_with("known names") || of_all.starts_with("did you mean"))
        refuse("parameters alone may stand here, and the model has none");
    throw error;
}

/// How a symbol that is given an array is declared as a family.
std::string family_hint(const std::string& name, const Shape& shape)
{
    if (shape.rank == Rank::vector)
        return fmt::format("a vector is declared with its range: \"{}[1..{}]\" = ..", name, shape.rows);
    return fmt::format("a matrix is declared with its ranges: \"{}[1..{},1..{}]\" = ..", name, shape.rows,
                       shape.columns);
}

/// True where a derivative or a function of the model is called with as many arguments as it has.
bool is_call(const Model& model, const TreeNode& node)
{
    const DerivativeEntry* derivative = find_derivative(node.name);
    const std::size_t count = node.arguments.size();
    return (derivative != nullptr && derivative->arity == count) ||
           std::ranges::any_of(model.definitions, [&](const Definition& each) {
               return each.name == node.name && count > 0 && each.parameters.size() == count;
           });
}

/// The names in the body of a function that nobody calls: what shapes its parameters have, only a call can say. Parsed
/// trees are at most 1024 levels deep, so plain recursion is safe.
void require_names(const ModelReader& reader, const Tree& tree, const std::vector<std::string>& bound)
{
    const bool is_free = tree->kind == TreeKind::name && std::ranges::find(bound, tree->name) == bound.end();
    if (is_free || (tree->kind == TreeKind::apply && !is_call(reader.model, *tree)))
        (void)reader.arrows.close_array(tree, true);
    std::vector<std::string> inside = bound;
    const bool binds = tree->kind == TreeKind::sum_over || tree->kind == TreeKind::product_over;
    if (binds) inside.push_back(tree->name);
    for (std::size_t k = 0; k < tree->arguments.size(); ++k)
        require_names(reader, tree->arguments[k], binds && k == 2 ? inside : bound);
}

/// Unused definitions are read too: an error in one should not wait for its first use.
void require_sound_definitions(const ModelReader& reader)
{
    for (const Definition& definition : reader.model.definitions)
        if (definition.parameters.empty())
            (void)reader.arrows.close_array(name(definition.name, definition.where), true);
        else
            require_names(reader, definition.body, definition.parameters);
}

/// Explains the names that observables, invariants and events may use and the model's other expressions may not.
void explain_observed(Scope& scope, const Model& model)
{
    const auto explain = [&](Roles roles, const char* hint) {
        for (const std::string& each : declared_names(symbols_of(model, roles))) scope.explain(each, hint);
    };
    explain(Role::momentum, "momenta stand in H, observables, invariants and events only");
    explain(Role::control, "controls stand in sigma, cost, observables, invariants and events only");
    explain(Role::input, "inputs stand in forces, sigma, [states], observables and events only");
    explain(Role::state, "first-order states stand in forces, [states], observables, invariants and events only");
    explain(Role::element | Role::next, "coordinates of an arrow stand in the discrete Lagrangian, the action (the "
                                        "element alone), observables and columns of discrete scenes only");
    scope.explain("energy", "the energy stands in observables, invariants and events only");
    scope.explain("hamiltonian", "the Hamiltonian stands in observables, invariants and events only");
}

/// Who misses a name of a state has parameters enough before the eyes.
void list_parameters_last(Scope& scope, const Model& model)
{
    scope.list_last("t");
    for (const std::string& parameter : declared_names(symbols_of(model, Role::parameter))) scope.list_last(parameter);
    for (const Size& size : model.sizes) scope.list_last(size.name);
}

/// The coordinates of an arrow stand where no motion in continuous time is asked for.
void explain_arrows(Scope& scope, const Model& model)
{
    if (!model.groupoid) return;
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
    add_to_scope(reader.arrows, model, Role::element | Role::next);
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

Item ModelReader::at(std::string_view block) const
{
    // These two are about the sections of the algebroid, which a tangent probe leaves out.
    return is_tangent && (block == "groupoid" || block == "discrete") ? Item() : Item(document).at(block);
}

Roles ModelReader::legal(Roles roles) const
{
    if (!is_nonholonomic(model) || roles == any_role || !roles.has(Role::fibre) || roles.has(Role::ambient))
        return roles;
    roles.bits &= ~Roles(Role::fibre).bits;
    return roles | Role::ambient;
}

const Scope& ModelReader::scope_for(Roles roles) const
{
    if (roles.has(Role::element) || roles.has(Role::next)) return arrows;
    for (const Role role : {Role::momentum, Role::control, Role::state, Role::input})
        if (roles.has(role)) return mechanical;
    return model.scope;
}

ArrayValue ModelReader::close_in(const Scope& scope, const Tree& tree, Roles roles, const std::string& what,
                                 bool nonsmooth, bool scalar) const
{
    roles = legal(roles);
    try {
        ArrayValue closed =
            scalar ? ArrayValue{{}, {scope.close(tree, nonsmooth)}} : scope.close_array(tree, nonsmooth);
        require_roles(closed.entries, *this, roles, tree->where, what);
        return closed;
    } catch (const UnknownSymbol& error) {
        refuse_unknown(error, *this, scope, roles);
    }
}

ArrayValue ModelReader::close(const Tree& tree, Roles roles, const std::string& what, bool nonsmooth) const
{
    return close_in(scope_for(roles), tree, roles, what, nonsmooth);
}

Tree ModelReader::scalar(const Tree& tree, Roles roles, const std::string& what, bool nonsmooth) const
{
    return close_in(roles == any_role ? observer : scope_for(roles), tree, roles, what, nonsmooth, true).entries[0];
}

ArrayValue ModelReader::array(const Item& item) const
{
    return close(read_array_expression(item.value(), item.title()), item.row().roles, item.title(),
                 item.row().nonsmooth);
}

Tree ModelReader::scalar(const Item& item) const
{
    return scalar(read_expression(item.value(), item.title()), item.row().roles, item.title(), item.row().nonsmooth);
}

std::vector<Tree> ModelReader::entries(const Item& item, const Shape& shape, Roles roles) const
{
    const ArrayValue closed = close(read_array_expression(item.value(), item.title()), roles, item.title());
    return fit_values(closed, shape, item.title(), item.value().where);
}

void ModelReader::read_values(const Item& table, const std::vector<Symbol>& symbols, const char* noun, const Take& take,
                              const Hint& hint) const
{
    const auto values = [&](const Item& item, const RunningKey& each) {
        const std::string what = item.title_of(each.key.name);
        const Tree parsed = replace_names(read_array_expression(item.value(), item.title()), each.indices);
        return fit_values(close(parsed, item.row().roles, what, item.row().nonsmooth), each.key.shape, what,
                          item.value().where);
    };
    read_table(table, symbols, noun, model.scope, values, take, hint);
}

void ModelReader::declare_keys(const Item& block, Role role)
{
    for (const Item& item : block.items()) declare_symbols(*this, read_declaration(*this, item.key()).symbols, role);
}

void ModelReader::read_declared(const Item& block, const std::function<void(std::size_t, const Tree&)>& take) const
{
    std::size_t next = 0;
    for (const Item& item : block.items()) {
        const DeclaredKey key = read_declaration(*this, item.key());
        const std::string what = item.title_of(key.name);
        const ArrayValue closed =
            close(read_array_expression(item.value(), what), item.row().roles, what, item.row().nonsmooth);
        const std::string hint = key.shape.rank == Rank::scalar ? family_hint(key.name, closed.shape) : "";
        for (const Tree& value : fit_values(closed, key.shape, what, item.value().where, hint)) take(next++, value);
    }
}

std::vector<NamedTree> read_given(const ModelReader& reader, const Item& table, const std::vector<Symbol>& symbols,
                                  const char* noun, const ModelReader::Hint& hint)
{
    std::vector<NamedTree> given;
    reader.read_values(
        table, symbols, noun,
        [&](std::size_t k, const Tree& value, const Item& item) {
            given.push_back({symbols[k].name, value, item.where()});
        },
        hint);
    return given;
}

std::vector<ComponentEntry> read_components(const ModelReader& reader, const Item& table)
{
    std::vector<ComponentEntry> out;
    const char* noun = is_nonholonomic(reader.model) ? "ambient fibre coordinate" : "fibre coordinate";
    reader.read_values(table, ambient_fibre(reader.model), noun,
                       [&](std::size_t a, const Tree& value, const Item& item) {
                           if (!is_plain_zero(value)) out.push_back(ComponentEntry{a, value, item.where()});
                       });
    return out;
}

void append_entries(std::vector<NamedTree>& list, const NamedTree& named, const ArrayValue& value)
{
    for (std::size_t k = 0; k < value.entries.size(); ++k)
        list.push_back({entry_name(named.name, value.shape, k), value.entries[k], named.where});
}

void refuse_inputs_in(const Model& model, const std::vector<NamedTree>& invariants)
{
    const std::vector<Symbol> inputs = symbols_of(model, Role::input);
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
    const Roles fibre = has_constraints_alone(reader) ? Roles() : Role::fibre; // they are some of the ambient ones
    add_to_scope(scope, model, Role::parameter | Role::base | fibre | Role::ambient);
    for (const Definition& definition : model.definitions) scope.define(definition);
    for (const NamedTree& casimir : reader.casimirs) scope.define({casimir.name, {}, casimir.value, casimir.where});
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
    add_to_scope(reader.mechanical, model, Role::momentum | Role::control | Role::input | Role::state);
    reader.observer = reader.mechanical.with(extra);
    for (const std::string& quantity : extra) reader.observer.define({rate_name(quantity), {}, nullptr, {}});
    explain_rates(reader.observer, reader.rates);
    if (lagrangian && reader.lagrangian) {
        reader.observer.define(Definition{"lagrangian", {}, reader.lagrangian, model.lagrangian_where});
    }
    define_cost(reader);
    for (const NamedTree& each : reader.observables)
        if (reader.names.find(each.name)->role == Role::observable)
            reader.observer.define({each.name, {}, each.value, each.where});
    for (const NamedTree& each : reader.invariants)
        if (fresh(each.name)) reader.observer.define({each.name, {}, each.value, each.where});
    build_arrows(reader);
    if (!reader.is_probe) require_sound_definitions(reader);
}

} // namespace lagen
