// SPDX-License-Identifier: GPL-2.0-or-later
/// What included files declare joins the including model, under its names.
#include "model/algebroid_draft.hpp"

#include "expression/find_part.hpp"
#include "expression/rewrite.hpp"
#include "model/families.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

/// Where a parameter got its value from, so far.
using Owners = std::map<std::string, const IncludedModel*>;

void merge_parameters(ModelReader& reader, const IncludedModel& included, Owners& owners)
{
    std::vector<Symbol> fresh;
    std::vector<Tree> values;
    for (const Parameter& parameter : included.model.parameters) {
        const std::string& name = parameter.symbol.name;
        const auto owner = owners.find(name);
        const Names::Entry* entry = reader.names.find(name);
        if (owner == owners.end() && entry != nullptr && entry->role == Role::parameter) continue; // given by the model
        if (owner == owners.end()) {
            fresh.push_back(parameter.symbol);
            values.push_back(parameter.value);
            continue;
        }
        const std::vector<Parameter>& others = owner->second->model.parameters;
        const auto other = std::ranges::find_if(others, [&](const Parameter& p) { return p.symbol.name == name; });
        if (same_tree(other->value, parameter.value)) continue;
        throw ModelError(fmt::format("the parameter '{}' is {} in {} and {} in {}", name, to_text(other->value),
                                     owner->second->model.file->name, to_text(parameter.value),
                                     included.model.file->name),
                         included.of->where, fmt::format("give it a value in this file: [parameters] {} = ..", name));
    }
    const std::size_t first = reader.model.parameters.size();
    declare_symbols(reader, fresh, Role::parameter);
    for (std::size_t k = 0; k < values.size(); ++k) reader.model.parameters[first + k].value = values[k];
    for (const Parameter& parameter : included.model.parameters) owners.emplace(parameter.symbol.name, &included);
}

/// Sizes of the file stand in its definitions.
void merge_sizes(ModelReader& reader, const IncludedModel& included)
{
    for (const Size& size : included.model.sizes) {
        const auto same = [&](const Size& each) { return each.name == size.name; };
        if (std::ranges::any_of(reader.model.sizes, same)) continue; // it has the same value: see include_model
        reader.names.declare(size.name, Role::size, size.where);
        reader.model.sizes.push_back(size);
        reader.model.scope.declare_size(size.name, size.value, size.where);
    }
}

/// A key as if it had been read at `where`.
Excerpt excerpt_of(const std::string& text, const SourceRange& where)
{
    Excerpt out{where.file, text, {}};
    for (std::size_t k = 0; k <= text.size(); ++k) out.origin.push_back(std::min(where.begin + k, where.end));
    return out;
}

/// The Casimirs of factors may bear one name: the second is name_2.
std::string fresh_name(const Names& names, const std::string& wanted)
{
    std::string name = wanted;
    const auto taken = [&] {
        const Names::Entry* entry = names.find(name);
        return entry != nullptr && entry->role == Role::casimir;
    };
    for (std::size_t k = 2; taken(); ++k) name = wanted + "_" + std::to_string(k);
    return name;
}

void merge_base(ModelReader& reader, const IncludedModel& included)
{
    const Base& from = included.model.base;
    Base& to = reader.model.base;
    for (const Tree& tree : from.constraints) to.constraints.push_back(replace_names(tree, included.renamed));
    to.constraint_texts.insert(to.constraint_texts.end(), from.constraint_texts.begin(), from.constraint_texts.end());
    for (const Tree& tree : from.domain) to.domain.push_back(replace_names(tree, included.renamed));
    for (const NamedTree& casimir : from.casimirs) {
        const std::string name = fresh_name(reader.names, casimir.name);
        reader.names.declare(name, Role::casimir, casimir.where);
        reader.casimirs.emplace_back(excerpt_of(name, casimir.where), replace_names(casimir.value, included.renamed));
    }
    for (std::size_t i = 0; i < from.coordinates.size(); ++i) { // [about] of the file, where the model has none
        Symbol& symbol = to.coordinates[included.base[i]];
        if (symbol.name == from.coordinates[i].name) symbol = from.coordinates[i];
    }
}

bool same_definition(const Definition& a, const Definition& b)
{
    return a.parameters == b.parameters && same_tree(a.body, b.body);
}

/// Every name and function that a tree mentions.
std::set<std::string> mentioned_in(const Tree& tree)
{
    std::set<std::string> names;
    for_each_part(tree, [&](const Tree& part) {
        if (part->kind == TreeKind::name || part->kind == TreeKind::apply) names.insert(family_name(part->name));
    });
    return names;
}

/// Names of definitions that use one of `hidden`, directly or through others.
std::set<std::string> definitions_using(const std::vector<Definition>& definitions, std::set<std::string> hidden)
{
    std::vector<std::set<std::string>> mentioned;
    for (const Definition& each : definitions) mentioned.push_back(mentioned_in(each.body));
    std::set<std::string> using_hidden;
    for (bool grown = true; grown;) {
        grown = false;
        for (std::size_t k = 0; k < definitions.size(); ++k) {
            const auto is_hidden = [&](const std::string& name) { return hidden.contains(name); };
            if (hidden.contains(definitions[k].name) || std::ranges::none_of(mentioned[k], is_hidden)) continue;
            using_hidden.insert(definitions[k].name);
            hidden.insert(definitions[k].name);
            grown = true;
        }
    }
    return using_hidden;
}

/// `renamed` with the families whose entries are renamed, and without the parameters of `definition`.
std::map<std::string, Tree> replacements_in(const Definition& definition, const IncludedModel& included)
{
    std::map<std::string, Tree> out = included.renamed;
    for (const auto* symbols : {&included.model.base.coordinates, &included.model.fibre.coordinates}) {
        for (const SymbolGroup& group : group_symbols(*symbols)) {
            std::vector<Tree> entries;
            bool changed = false;
            for (std::size_t k = 0; k < group.shape.size() && group.shape.rank != Rank::scalar; ++k) {
                const std::string& old = (*symbols)[group.first + k].name;
                const auto other = included.renamed.find(old);
                changed = changed || other != included.renamed.end();
                entries.push_back(other != included.renamed.end() ? other->second : name(old));
            }
            if (changed) out[group.name] = array_tree(group.shape, entries);
        }
    }
    for (const std::string& parameter : definition.parameters) out.erase(parameter);
    return out;
}

void define_inherited(ModelReader& reader, const IncludedModel& included, const Definition& definition)
{
    Definition own = definition;
    std::map<std::string, Tree> replacements = replacements_in(definition, included);
    for (std::string& parameter : own.parameters) {
        if (!introduces(replacements, parameter)) continue;
        const std::string fresh = uncaptured_name(parameter, definition.body, replacements);
        replacements[parameter] = name(fresh);
        parameter = fresh;
    }
    own.body = replace_names(definition.body, replacements);
    std::vector<Definition>& all = reader.model.definitions;
    const auto other = std::ranges::find_if(all, [&](const Definition& each) { return each.name == own.name; });
    if (other != all.end() && other->where.file != reader.model.file) {
        if (same_definition(*other, own)) return;
        throw ModelError(fmt::format("the definition '{}' of {} differs from that of {}", own.name,
                                     included.model.file->name, other->where.file->name),
                         included.of->where, "rename one of them in its file");
    }
    reader.names.declare(own.name, Role::definition, own.where);
    reader.model.scope.define(own);
    all.push_back(std::move(own));
}

} // namespace

void merge_included(ModelReader& reader)
{
    Owners owners;
    for (const IncludedModel& included : reader.included) {
        merge_sizes(reader, included);
        merge_parameters(reader, included, owners);
        merge_base(reader, included);
    }
}

void note_fibre_names(ModelReader& reader, const AlgebroidDraft& draft, const AlgebroidBlock& block, bool hidden)
{
    if (draft.kind == nullptr) {
        IncludedModel& included = reader.included[draft.included];
        included.fibre_is_hidden = hidden;
        const std::vector<Symbol>& own = included.model.fibre.coordinates;
        for (std::size_t a = 0; a < own.size(); ++a)
            if (own[a].name != block.fibre[a].name) included.renamed.emplace(own[a].name, name(block.fibre[a].name));
        return;
    }
    for (std::size_t k = 0; k < draft.of.size(); ++k)
        note_fibre_names(reader, draft.of[k], block.of[k], hidden || block.dual);
}

void inherit_definitions(ModelReader& reader)
{
    for (const IncludedModel& included : reader.included) {
        std::set<std::string> hidden;
        if (included.fibre_is_hidden) {
            for (const std::string& name : declared_names(included.model.fibre.coordinates)) hidden.insert(name);
            for (const std::string& name : velocity_names(included.model)) hidden.insert(name);
        }
        const std::set<std::string> dropped = definitions_using(included.model.definitions, hidden);
        for (const Definition& definition : included.model.definitions)
            if (!dropped.contains(definition.name)) define_inherited(reader, included, definition);
    }
}

} // namespace lagen
