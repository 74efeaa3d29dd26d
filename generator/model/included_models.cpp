// SPDX-License-Identifier: GPL-2.0-or-later
/// Model files that `of` names, relative to the file that names them. What they declare joins the including model under
/// its names. Their Lagrangians, with forces and dissipation, become the model's where it has neither a Lagrangian nor
/// a Hamiltonian nor a control problem of its own. A frame e'_a = A_a^b e_b pulls all of them back: L' = L and R' = R
/// at y^b = A_a^b y'^a, Q'_a = A_a^b Q_b. Hamiltonians and control problems of files are left where they are: their
/// momenta and their sigma would need the inverse of A.
#include "expression/find_part.hpp"
#include "expression/rewrite.hpp"
#include "model/algebroid_draft.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 64;

/// The same text for the same file, however it is spelled.
std::string identity_of(const fs::path& path)
{
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(path, error);
    return error ? path.lexically_normal().string() : whole.string();
}

void require_no_cycle(const IncludeTrail& trail, const std::string& identity, const SourceRange& where)
{
    const auto first = std::ranges::find(trail.open, identity);
    if (first == trail.open.end()) return;
    std::string cycle;
    for (auto each = first; each != trail.open.end(); ++each) cycle += fs::path(*each).filename().string() + " -> ";
    throw ModelError(
        fmt::format("the models include each other in a cycle: {}{}", cycle, fs::path(identity).filename().string()),
        where, "a file may not be part of itself");
}

void list_once(std::vector<std::shared_ptr<const SourceFile>>& files, const std::shared_ptr<const SourceFile>& file)
{
    const auto same = [&](const auto& each) { return each->name == file->name; };
    if (std::ranges::none_of(files, same)) files.push_back(file);
}

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
        const auto other = std::ranges::find(
            others, name, [](const Parameter& each) -> const std::string& { return each.symbol.name; });
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
        std::vector<Size>& sizes = reader.model.sizes;
        if (std::ranges::find(sizes, size.name, &Size::name) != sizes.end()) continue; // of the same value: it was set
        reader.names.declare(size.name, Role::size, size.where);
        reader.model.sizes.push_back(size);
        reader.model.scope.declare_size(size.name, size.value, size.where);
    }
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
        reader.casimirs.push_back({name, replace_names(casimir.value, included.renamed), casimir.where});
    }
    for (std::size_t i = 0; i < from.coordinates.size(); ++i) { // [about] of the file, where the model has none
        Symbol& symbol = to.coordinates[included.base[i]];
        if (symbol.name == from.coordinates[i].name) symbol = from.coordinates[i];
    }
}

/// `hidden`, and the names of the definitions that use one of them, directly or through others.
std::set<std::string> with_users(std::set<std::string> hidden, const std::vector<Definition>& definitions)
{
    const auto is_hidden = [&](const Tree& part) {
        const bool named = part->kind == TreeKind::name || part->kind == TreeKind::apply;
        return named && hidden.contains(family_name(part->name));
    };
    for (std::size_t before = hidden.size() + 1; before != hidden.size();) {
        before = hidden.size();
        for (const Definition& each : definitions)
            if (any_part(each.body, is_hidden)) hidden.insert(each.name);
    }
    return hidden;
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
    const auto other = std::ranges::find(all, own.name, &Definition::name);
    if (other != all.end() && other->where.file != reader.model.file) {
        if (other->parameters == own.parameters && same_tree(other->body, own.body)) return;
        throw ModelError(fmt::format("the definition '{}' of {} differs from that of {}", own.name,
                                     included.model.file->name, other->where.file->name),
                         included.of->where, "rename one of them in its file");
    }
    reader.names.declare(own.name, Role::definition, own.where);
    reader.model.scope.define(own);
    all.push_back(std::move(own));
}

Tree in_model(const IncludedModel& included, const Tree& tree)
{
    std::map<std::string, Tree> replacements = included.velocities;
    replacements.insert(included.renamed.begin(), included.renamed.end());
    return replace_names(tree, replacements);
}

/// The files below `draft` that L can come from. A prolongation has no use for one: there it would be a function on the
/// base.
void append_files(std::vector<const IncludedModel*>& files, bool& complete, const ModelReader& reader,
                  const AlgebroidDraft& draft)
{
    if (!draft.kind) {
        files.push_back(&reader.included[draft.included]);
        return;
    }
    if (*draft.kind == AlgebroidKind::prolongation || draft.of.empty()) complete = false;
    for (const AlgebroidDraft& inner : draft.of) append_files(files, complete, reader, inner);
}

/// Q_a of a block, null where it is zero.
std::vector<Tree> forces_of(const ModelReader& reader, const AlgebroidDraft& draft, const AlgebroidBlock& block)
{
    if (block.kind == AlgebroidKind::nonholonomic) return forces_of(reader, draft.of[0], block.of[0]);
    std::vector<Tree> forces(block.fibre.size());
    if (!draft.kind) {
        const IncludedModel& included = reader.included[draft.included];
        for (const ComponentEntry& force : included.model.forces)
            forces[force.section] = in_model(included, force.value);
    } else if (block.kind == AlgebroidKind::product) {
        auto next = forces.begin();
        for (std::size_t k = 0; k < block.of.size(); ++k)
            for (Tree& force : forces_of(reader, draft.of[k], block.of[k])) *next++ = std::move(force);
    } else if (block.kind == AlgebroidKind::frame) {
        const std::vector<Tree> inner = forces_of(reader, draft.of[0], block.of[0]);
        std::vector<std::vector<Tree>> terms(forces.size());
        for (const SectionEntry& entry : block.sections)
            if (inner[entry.inner]) terms[entry.section].push_back(product_of(entry.value, inner[entry.inner]));
        for (std::size_t a = 0; a < forces.size(); ++a) forces[a] = terms[a].empty() ? nullptr : sum_of(terms[a]);
    }
    return forces;
}

/// Forces do not come without the inputs in them and the states that they follow from.
void refuse_lost(const IncludedModel& file, const std::vector<Symbol>& symbols, const char* noun, const char* block)
{
    for (const ComponentEntry& force : file.model.forces)
        for (const std::string& name : names_in(force.value))
            if (index_of(symbols, name) < symbols.size())
                throw ModelError(fmt::format("the forces of '{}' depend on its {} '{}', and {} do not come with the "
                                             "forces of a file",
                                             file.model.file->name, noun, name, block),
                                 file.of->where, fmt::format("give this model {} and [forces] of its own", block));
}

} // namespace

std::size_t include_model(ModelReader& reader, const TomlValue& of)
{
    IncludeTrail& trail = *reader.trail;
    if (trail.open.empty()) trail.open.push_back(identity_of(reader.model.file->name));
    const std::shared_ptr<const SourceFile> file = file_named(of, "'of'");
    require_no_cycle(trail, identity_of(file->name), of.where);
    if (++trail.read > most_files)
        throw complain::too_many("the model", trail.read, "included files", most_files, of.where);
    std::vector<Setting> sizes; // where the file has them: those of this model, then those of the command line
    for (const Size& size : reader.model.sizes)
        sizes.push_back({size.name, whole_text("<sizes>", std::to_string(size.value)), false, true});
    for (Setting setting : *reader.settings) {
        setting.sizes_alone = true;
        sizes.push_back(std::move(setting));
    }
    trail.open.push_back(identity_of(file->name));
    IncludedModel included;
    included.of = &of;
    included.model = read_model_text(file->name, file->text, sizes, trail);
    trail.open.pop_back();
    const Scope& scope = included.model.scope;
    const auto is_pi = [](const Definition& definition) { return definition.name == "pi"; };
    const bool has_pi = scope.has_symbol("pi") || scope.find_family("pi") || scope.find_size("pi").has_value() ||
                        std::ranges::any_of(included.model.definitions, is_pi);
    if (!has_pi) included.renamed.emplace("pi", constant_pi()); // whatever the including model calls pi
    list_once(reader.model.included, included.model.file);
    for (const auto& each : included.model.included) list_once(reader.model.included, each);
    reader.included.push_back(std::move(included));
    return reader.included.size() - 1;
}

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
    if (!draft.kind) {
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
        const std::set<std::string> dropped = with_users(std::move(hidden), included.model.definitions);
        for (const Definition& definition : included.model.definitions)
            if (!dropped.contains(definition.name)) define_inherited(reader, included, definition);
    }
}

void inherit_mechanics(ModelReader& reader)
{
    if (reader.at("lagrangian") || reader.at("hamiltonian") || reader.at("control")) return;
    std::vector<const IncludedModel*> files;
    bool complete = true;
    append_files(files, complete, reader, *reader.draft);
    const auto has_none = [](const IncludedModel* file) { return file->model.lagrangian == nullptr; };
    if (!complete || files.empty() || std::ranges::any_of(files, has_none)) return;
    std::vector<Tree> lagrangians, dissipations;
    for (const IncludedModel* file : files) {
        lagrangians.push_back(in_model(*file, file->model.lagrangian));
        if (file->model.dissipation) dissipations.push_back(in_model(*file, file->model.dissipation));
    }
    const SourceRange where = files.front()->of->where;
    reader.lagrangian = sum_of(lagrangians);
    reader.model.lagrangian_where = where;
    if (!reader.at("dissipation") && !dissipations.empty()) reader.dissipation = sum_of(dissipations);
    if (reader.at("forces")) return;
    for (const IncludedModel* file : files) {
        refuse_lost(*file, symbols_of(file->model, Role::state), "first-order state", "[states]");
        refuse_lost(*file, symbols_of(file->model, Role::input), "input", "[inputs]");
    }
    const std::vector<Tree> forces = forces_of(reader, *reader.draft, reader.model.algebroid);
    for (std::size_t a = 0; a < forces.size(); ++a)
        if (forces[a]) reader.inherited_forces.push_back({a, forces[a], where});
}

} // namespace lagen
