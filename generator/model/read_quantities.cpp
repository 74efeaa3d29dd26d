// SPDX-License-Identifier: GPL-2.0-or-later
/// Scopes, and the blocks that are lists of named expressions: definitions, Lagrangian, observables, invariants, about.
#include "model/model_reader.hpp"

#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

using Named = std::vector<std::pair<Excerpt, Tree>>;

Named read_named(const TomlEntry* block, const char* title, const char* noun)
{
    Named out;
    if (block == nullptr) return out;
    const TableReader table(block->value, title);
    for (const TomlEntry& entry : block->value.entries) {
        require_identifier(entry.name(), entry.where(), "a name");
        out.emplace_back(entry.key, read_expression(entry.value, fmt::format("the {} '{}'", noun, entry.name())));
    }
    return out;
}

SourceRange place_of(const Excerpt& key)
{
    return key.range(0, key.text.size());
}

/// The first name in `tree` that plays none of `roles`; walks shared trees once.
const TreeNode* first_forbidden(const Tree& tree, const Names& names, std::initializer_list<Role> roles)
{
    std::set<const TreeNode*> seen;
    std::vector<const TreeNode*> stack{tree.get()};
    while (!stack.empty()) {
        const TreeNode* node = stack.back();
        stack.pop_back();
        if (!seen.insert(node).second) continue;
        if (node->kind == TreeKind::name) {
            const Names::Entry* entry = names.find(node->name);
            const Role role = entry != nullptr ? entry->role : node->name == "t" ? Role::time : Role::built_in;
            if (std::find(roles.begin(), roles.end(), role) == roles.end()) return node;
        }
        for (auto argument = node->arguments.rbegin(); argument != node->arguments.rend(); ++argument) {
            stack.push_back(argument->get());
        }
    }
    return nullptr;
}

/// An observable may bear the name of a definition only if it is that definition.
void declare_observable(ModelReader& reader, const Excerpt& key, const Tree& value)
{
    const Names::Entry* entry = reader.names.find(key.text);
    const bool same =
        entry != nullptr && entry->role == Role::definition && value->kind == TreeKind::name && value->name == key.text;
    if (!same) reader.names.declare(key.text, Role::observable, place_of(key));
}

/// Unused definitions are read too: an error in one should not wait for its first use.
void require_sound_definitions(const ModelReader& reader)
{
    for (const Definition& definition : reader.model.definitions) {
        if (definition.parameters.empty()) {
            (void)reader.close_observed(name(definition.name, definition.where));
        } else {
            (void)reader.observer.with(definition.parameters).close(definition.body, true);
        }
    }
}

} // namespace

Tree ModelReader::close(const Tree& tree, std::initializer_list<Role> roles, const std::string& what) const
{
    const Tree closed = model.scope.close(tree);
    if (const TreeNode* bad = first_forbidden(closed, names, roles)) {
        const Names::Entry* entry = names.find(bad->name);
        const Role role = entry != nullptr ? entry->role : bad->name == "t" ? Role::time : Role::built_in;
        std::string allowed;
        for (const Role each : roles) {
            const std::string_view text = role_text(each);
            const char* plural = each == Role::time ? "" : "s";
            allowed += fmt::format("{}{}{}", allowed.empty() ? "" : ", ", text.substr(text.find(' ') + 1), plural);
        }
        throw ModelError(
            fmt::format("{} may not depend on {} ('{}')", what, std::string_view(role_text(role)), bad->name),
            bad->where.file ? bad->where : tree->where, "allowed here: " + allowed);
    }
    return closed;
}

void declare_quantities(ModelReader& reader, const TomlEntry* observables, const TomlEntry* invariants,
                        const TomlEntry* lagrangian)
{
    reader.observables = read_named(observables, "[observables]", "observable");
    for (const auto& [key, value] : reader.observables) declare_observable(reader, key, value);
    reader.invariants = read_named(invariants, "[invariants]", "invariant");
    if (lagrangian == nullptr) return;
    TableReader table(lagrangian->value, "[lagrangian]");
    const TomlEntry* entry = table.take("L");
    table.finish();
    if (entry == nullptr) {
        throw ModelError("[lagrangian] has no key 'L'", lagrangian->where(), "[lagrangian] L = \"..\"");
    }
    reader.lagrangian = read_expression(entry->value, "the Lagrangian 'L'");
    reader.model.lagrangian_where = entry->value.where;
}

void build_scopes(ModelReader& reader)
{
    Model& model = reader.model;
    Scope& scope = model.scope;
    scope.declare("t", {});
    for (const Parameter& parameter : model.parameters) scope.declare(parameter.symbol.name, parameter.symbol.where);
    for (const Symbol& symbol : model.base.coordinates) scope.declare(symbol.name, symbol.where);
    for (const Symbol& symbol : model.fibre.coordinates) scope.declare(symbol.name, symbol.where);
    for (const Definition& definition : model.definitions) scope.define(definition);
    for (const auto& [key, value] : reader.casimirs) scope.define(Definition{key.text, {}, value, place_of(key)});

    std::set<std::string> used(reader.names.order().begin(), reader.names.order().end());
    std::vector<std::string> extra = names_of(model.fibre.momenta);
    const auto fresh = [&used](const std::string& name) { return used.insert(name).second; };
    if (fresh("energy")) extra.push_back("energy");
    const bool lagrangian = fresh("lagrangian");
    if (lagrangian && !reader.lagrangian) extra.push_back("lagrangian");
    reader.observer = scope.with(extra);
    if (lagrangian && reader.lagrangian) {
        reader.observer.define(Definition{"lagrangian", {}, reader.lagrangian, model.lagrangian_where});
    }
    for (const auto& [key, value] : reader.observables) {
        const Names::Entry* entry = reader.names.find(key.text);
        if (entry->role == Role::observable) reader.observer.define(Definition{key.text, {}, value, place_of(key)});
    }
    for (const auto& [key, value] : reader.invariants) {
        if (fresh(key.text)) reader.observer.define(Definition{key.text, {}, value, place_of(key)});
    }
    require_sound_definitions(reader);
}

void read_quantities(ModelReader& reader)
{
    Model& model = reader.model;
    const auto state = {Role::time, Role::parameter, Role::base, Role::fibre};
    if (reader.lagrangian) model.lagrangian = reader.close(reader.lagrangian, state, "the Lagrangian");
    for (const auto& [key, value] : reader.observables) {
        model.observables.push_back(NamedTree{key.text, reader.close_observed(value), place_of(key)});
    }
    for (const auto& [key, value] : reader.invariants) {
        model.invariants.push_back(NamedTree{key.text, reader.observer.close(value), place_of(key)});
    }
}

void read_about(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    const TableReader blocks(block->value, "[about]");
    std::vector<std::string> known = reader.names.order();
    known.emplace_back("t");
    for (const auto& [key, value] : reader.invariants) known.push_back(key.text);
    Model& model = reader.model;
    std::vector<Symbol*> symbols;
    for (Parameter& parameter : model.parameters) symbols.push_back(&parameter.symbol);
    for (auto* list : {&model.base.coordinates, &model.fibre.coordinates, &model.fibre.momenta}) {
        for (Symbol& symbol : *list) symbols.push_back(&symbol);
    }
    for (const TomlEntry& entry : block->value.entries) {
        if (std::find(known.begin(), known.end(), entry.name()) == known.end()) {
            throw ModelError(fmt::format("[about] describes '{}', which the model does not declare", entry.name()),
                             entry.where(), hint_for(entry.name(), known, "names"));
        }
        TableReader table(entry.value, fmt::format("'{}' of [about]", entry.name()));
        Symbol about{entry.name(), entry.where(), {}, {}, {}};
        const auto take = [&](const char* key, std::string& text) {
            const TomlEntry* field = table.take(key);
            if (field != nullptr) text = read_text(field->value, fmt::format("the {} of '{}'", key, entry.name()));
        };
        take("text", about.text);
        take("unit", about.unit);
        take("latex", about.latex);
        table.finish();
        const auto same = [&](const Symbol* symbol) { return symbol->name == about.name; };
        const auto place = std::find_if(symbols.begin(), symbols.end(), same);
        if (place == symbols.end()) {
            model.notes.push_back(std::move(about));
        } else {
            about.where = (*place)->where;
            **place = std::move(about);
        }
    }
}

} // namespace lagen
