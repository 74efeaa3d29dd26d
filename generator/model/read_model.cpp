// SPDX-License-Identifier: GPL-2.0-or-later
/// The blocks of a model file, in the order in which they can be understood.
#include "model/read_model.hpp"

#include "model/algebroid_draft.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace lagen {

namespace {

Model read_with(ModelReader& reader, const std::string& name, std::string text, const std::vector<Setting>& settings,
                IncludeTrail& trail);

/// The model as far as its base; `as_tangent`: whatever its algebroid is, as TM.
Model probed(const ModelReader& reader, bool as_tangent)
{
    IncludeTrail trail = *reader.trail;
    ModelReader probe;
    probe.is_probe = true;
    probe.is_tangent = as_tangent;
    const SourceFile& file = *reader.model.file;
    return read_with(probe, file.name, file.text, *reader.settings, trail);
}

void read_header(ModelReader& reader)
{
    Model& model = reader.model;
    if (const Item title = reader.at("title")) model.title = title.text();
    const Item name = reader.at("name");
    model.name = name ? name.text() : std::filesystem::path(model.file->name).stem().string();
    model.name_where = name ? name.value().where : SourceRange{model.file, 0, 0};
    require_class_name(model.name, model.name_where, !name);
}

void declare_base(ModelReader& reader)
{
    declare_symbols(reader, read_names(reader, reader.at("base").at("coordinates")), Role::base);
    for (const Item& casimir : reader.at("base").at("casimirs").items()) {
        reader.names.declare(casimir.name(), Role::casimir, casimir.where());
        reader.casimirs.push_back({casimir.name(), read_expression(casimir.value(), casimir.title()), casimir.where()});
    }
}

/// "V(q, r)" as a name and its parameters; "T" as a name alone.
Definition read_definition_key(const Excerpt& key)
{
    Definition out;
    const std::size_t open = key.text.find('(');
    const Excerpt name = trimmed(key, 0, std::min(open, key.text.size()));
    out.name = name.text;
    out.where = place_of(name);
    if (open == std::string::npos) return out;
    const Excerpt tail = trimmed(key, open + 1, key.text.size());
    if (tail.text.empty() || tail.text.back() != ')')
        throw ModelError(fmt::format("the definition '{}' has no closing parenthesis at its end", key.text),
                         place_of(key), "write \"V(q)\" = \"..\"");
    for (const Excerpt& parameter : split_at_commas(trimmed(tail, 0, tail.text.size() - 1))) {
        const SourceRange where = place_of(parameter);
        require_identifier(parameter.text, where, "the parameter of a function");
        for (const std::string& earlier : out.parameters) {
            if (earlier != parameter.text) continue;
            throw complain::names_twice(fmt::format("the function '{}'", out.name), earlier, where,
                                        "its parameters differ");
        }
        out.parameters.push_back(parameter.text);
    }
    return out;
}

void declare_definitions(ModelReader& reader)
{
    for (const Item& item : reader.at("definitions").items()) {
        Definition definition = read_definition_key(item.key());
        reader.names.declare(definition.name, Role::definition, definition.where);
        definition.body = read_expression(item.value(), item.title());
        reader.model.definitions.push_back(std::move(definition));
    }
}

/// The named expressions of a block, parsed.
std::vector<NamedTree> read_named(const Item& block)
{
    std::vector<NamedTree> out;
    for (const Item& item : block.items()) {
        require_identifier(item.name(), item.where(), "a name");
        out.push_back({item.name(), read_expression(item.value(), item.title()), item.where()});
    }
    return out;
}

/// An observable may bear the name of a definition only if it is that definition.
void declare_quantities(ModelReader& reader)
{
    reader.observables = read_named(reader.at("observables"));
    reader.invariants = read_named(reader.at("invariants"));
    for (const auto& [name, value, where] : reader.observables) {
        const Names::Entry* entry = reader.names.find(name);
        const bool same =
            entry != nullptr && entry->role == Role::definition && value->kind == TreeKind::name && value->name == name;
        if (!same) reader.names.declare(name, Role::observable, where);
    }
}

void read_quantities(ModelReader& reader)
{
    Model& model = reader.model;
    for (const NamedTree& each : reader.observables)
        append_entries(model.observables, each, reader.arrows.close_array(each.value, true));
    for (const NamedTree& each : reader.invariants)
        append_entries(model.invariants, each, reader.observer.close_array(each.value));
    refuse_inputs_in(model, model.invariants);
}

void declare_all(ModelReader& reader)
{
    read_header(reader);
    read_sizes(reader);
    reader.declare_keys(reader.at("parameters"), Role::parameter);
    declare_base(reader);
    declare_groupoid(reader);
    read_algebroid_kind(reader);
    declare_ambient(reader);
    require_rules(reader, Known::algebroid);
    declare_fibre(reader);
    declare_control(reader);
    reader.declare_keys(reader.at("inputs"), Role::input);
    reader.declare_keys(reader.at("states"), Role::state);
    declare_reconstructions(reader);
    declare_definitions(reader);
    declare_quantities(reader);
    declare_mechanics(reader);
    require_rules(reader, Known::blocks);
    declare_discrete(reader);
    for (const Item& form : reader.at("forms").items()) reader.names.declare(form.name(), Role::form, form.where());
    declare_total_cost(reader);
    build_scopes(reader);
}

Model read_with(ModelReader& reader, const std::string& name, std::string text, const std::vector<Setting>& settings,
                IncludeTrail& trail)
{
    reader.settings = &settings;
    reader.trail = &trail;
    Model& model = reader.model;
    model.file = std::make_shared<const SourceFile>(SourceFile{name, std::move(text)});
    reader.document.value = parse_toml(model.file);
    for (const char* key : {"morphism", "compose"})
        if (const Item item = reader.at(key))
            throw ModelError("this file is a morphism between models, where a model is wanted", item.where(),
                             "`lagen check`, `run` and `reduce` read morphisms");
    require_shape(Item(reader.document));
    declare_all(reader);
    read_parameters(reader);
    read_base(reader);
    if (reader.is_probe) return std::move(model);
    reader.read_declared(reader.at("inputs"), [&](std::size_t k, const Tree& value) { model.inputs[k].value = value; });
    read_mechanics(reader);
    reader.read_declared(reader.at("states"), [&](std::size_t k, const Tree& rate) { model.states[k].rate = rate; });
    read_reconstructions(reader);
    read_action(reader);
    read_discrete(reader);
    read_control(reader);
    read_quantities(reader);
    read_symmetries(reader);
    read_forms(reader);
    read_about(reader);
    read_scenes(reader);
    model.observer = std::move(reader.observer);
    model.columns = std::move(reader.arrows);
    return std::move(model);
}

} // namespace

Model read_model(const std::string& path, const std::vector<Setting>& settings, const Choosers& choosers)
{
    return read_model_text(path, read_file(path), settings, choosers);
}

Model read_model_text(const std::string& name, std::string text, const std::vector<Setting>& settings,
                      const Choosers& choosers)
{
    IncludeTrail trail;
    trail.choosers = &choosers;
    return read_model_text(name, std::move(text), settings, trail);
}

Model read_model_text(const std::string& name, std::string text, const std::vector<Setting>& settings,
                      IncludeTrail& trail)
{
    ModelReader reader;
    return read_with(reader, name, std::move(text), settings, trail);
}

std::optional<std::vector<Symbol>> chosen_coordinates(const ModelReader& reader)
{
    if (!reader.trail->choosers->kept) return std::nullopt;
    std::vector<Symbol> chosen;
    for (const std::size_t place : reader.trail->choosers->kept(probed(reader, false)))
        chosen.push_back(ambient_fibre(reader.model).at(place));
    return chosen;
}

LevelSetFrame frame_of_level_set(const ModelReader& reader, const LevelSetRequest& request)
{
    if (!reader.trail->choosers->frame) throw InternalError("a level set is read by nobody who makes its frame");
    return reader.trail->choosers->frame(probed(reader, true), request);
}

void declare_fibre(ModelReader& reader)
{
    if (reader.is_probe) return;
    Fibre& fibre = reader.model.fibre;
    const Item block = reader.at("fibre");
    if (const Item coordinates = block.at("coordinates")) {
        const std::vector<Symbol> names = read_names(reader, coordinates);
        if (has_constraints_alone(reader))
            keep_coordinates(reader, names);
        else
            declare_symbols(reader, names, Role::fibre);
        require_rank(reader, coordinates.value().where);
    } else if (const auto chosen = has_constraints_alone(reader) ? chosen_coordinates(reader) : std::nullopt) {
        keep_coordinates(reader, *chosen);
    } else if (const auto standard = default_fibre(reader)) {
        declare_symbols(reader, *standard, Role::fibre);
    } else if (reader.model.algebroid.kind != AlgebroidKind::first_order) {
        throw ModelError("the fibre coordinates are missing, one a section of the frame",
                         block ? block.where() : reader.model.algebroid.where,
                         "[fibre] coordinates = [\"y1\", \"y2\"]");
    }
    const Item given = block.at("momenta");
    std::vector<Symbol> momenta = read_names(reader, given);
    if (!given) momenta = with_names(fibre.coordinates, [](const std::string& name) { return "p_" + name; });
    declare_symbols(reader, momenta, Role::momentum);
    if (fibre.momenta.size() != fibre.coordinates.size())
        throw complain::wrong_number("momenta", fibre.momenta.size(), "the fibre", fibre.coordinates.size(),
                                     given.value().where);
}

const Scene& find_scene(const Model& model, const std::string& name)
{
    std::vector<std::string> known;
    for (const Scene& scene : model.scenes) {
        if (scene.name == (name.empty() ? "default" : name)) return scene;
        known.push_back(scene.name);
    }
    const SourceRange where{model.file, 0, 0};
    if (model.scenes.empty())
        throw ModelError("the model has no scene", where, "add [scene.default] with initial values and a duration");
    if (name.empty()) return model.scenes.front();
    throw ModelError(fmt::format("the model '{}' has no scene '{}'", model.file->name, name), {},
                     hint_for(name, known, "scenes"));
}

bool contains(const AlgebroidBlock& block, AlgebroidKind kind)
{
    return block.kind == kind ||
           std::ranges::any_of(block.of, [&](const AlgebroidBlock& inner) { return contains(inner, kind); });
}

bool is_nonholonomic(const Model& model)
{
    return model.algebroid.kind == AlgebroidKind::nonholonomic;
}

const std::vector<Symbol>& ambient_fibre(const Model& model)
{
    return is_nonholonomic(model) ? model.algebroid.of[0].fibre : model.fibre.coordinates;
}

std::vector<std::string> symbol_names(const Model& model)
{
    std::vector<std::string> out;
    const std::vector<Symbol>& fibre = model.fibre.coordinates;
    for_each_symbol(model, [&](Role role, const Symbol& symbol) {
        const bool kept = role == Role::ambient && index_of(fibre, symbol.name) < fibre.size();
        if (!kept && role != Role::momentum && role != Role::element && role != Role::next) out.push_back(symbol.name);
    });
    return out;
}

} // namespace lagen
