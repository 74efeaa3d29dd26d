// SPDX-License-Identifier: GPL-2.0-or-later
/// The blocks of a model file, in the order in which they can be understood.
#include "model/read_model.hpp"

#include "model/algebroid_draft.hpp"
#include "model/model_reader.hpp"
#include "model/read_file.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

Model read_with(ModelReader& reader, const std::string& name, std::string text, const std::vector<Setting>& settings,
                IncludeTrail& trail);

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
    ModelReader reader;
    return read_with(reader, name, std::move(text), settings, trail);
}

Model read_model_text(const std::string& name, std::string text, const std::vector<Setting>& settings,
                      IncludeTrail& trail)
{
    ModelReader reader;
    return read_with(reader, name, std::move(text), settings, trail);
}

namespace {

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

} // namespace

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

namespace {

Model read_with(ModelReader& reader, const std::string& name, std::string text, const std::vector<Setting>& settings,
                IncludeTrail& trail)
{
    reader.settings = &settings;
    reader.trail = &trail;
    reader.model.file = std::make_shared<const SourceFile>(SourceFile{name, std::move(text)});
    const TomlValue document = parse_toml(reader.model.file);
    TableReader top(document, "the model");
    for (const char* key : {"morphism", "compose"})
        if (const TomlEntry* entry = find_entry(document, key))
            throw ModelError("this file is a morphism between models, where a model is wanted", entry->where(),
                             "`lagen check`, `run` and `reduce` read morphisms");
    const TomlEntry* model_name = top.take("name");
    const TomlEntry* title = top.take("title");
    const TomlEntry* sizes = top.take("sizes");
    const TomlEntry* parameters = top.take("parameters");
    const TomlEntry* base = top.take("base");
    reader.fibre = top.take("fibre");
    reader.algebroid = top.take("algebroid");
    reader.groupoid = top.take("groupoid");
    reader.discrete = top.take("discrete");
    if (reader.is_tangent) reader.groupoid = reader.discrete = nullptr; // they are about its sections
    const TomlEntry* definitions = top.take("definitions");
    reader.mechanics.lagrangian = top.take("lagrangian");
    reader.mechanics.hamiltonian = top.take("hamiltonian");
    reader.mechanics.forces = top.take("forces");
    reader.mechanics.dissipation = top.take("dissipation");
    reader.mechanics.control = top.take("control");
    reader.inputs = top.take("inputs");
    reader.states = top.take("states");
    reader.reconstruct = top.take("reconstruct");
    const TomlEntry* observables = top.take("observables");
    const TomlEntry* invariants = top.take("invariants");
    const TomlEntry* symmetries = top.take("symmetries");
    const TomlEntry* forms = top.take("forms");
    const TomlEntry* hamilton_jacobi = top.take("hamilton_jacobi");
    const TomlEntry* about = top.take("about");
    const TomlEntry* scenes = top.take("scene");
    top.finish();

    read_header(reader, model_name, title, name);
    read_sizes(reader, sizes, settings);
    declare_parameters(reader, parameters);
    declare_base(reader, base);
    declare_groupoid(reader);
    read_algebroid_kind(reader, reader.algebroid);
    declare_ambient(reader);
    declare_fibre(reader, reader.fibre);
    declare_control(reader);
    declare_inputs(reader);
    declare_states(reader);
    declare_reconstructions(reader);
    declare_definitions(reader, definitions);
    declare_quantities(reader, observables, invariants);
    declare_mechanics(reader);
    declare_discrete(reader);
    declare_forms(reader, forms);
    declare_total_cost(reader);
    build_scopes(reader);

    read_parameters(reader, parameters, settings);
    read_base(reader, base);
    if (reader.is_probe) return std::move(reader.model);
    read_inputs(reader);
    read_mechanics(reader);
    read_states(reader);
    read_reconstructions(reader);
    read_action(reader);
    read_discrete(reader);
    read_control(reader);
    read_quantities(reader);
    read_symmetries(reader, symmetries);
    read_forms(reader, forms);
    read_hamilton_jacobi(reader, hamilton_jacobi);
    read_about(reader, about);
    read_scenes(reader, scenes, settings);
    reader.model.observer = std::move(reader.observer);
    reader.model.columns = std::move(reader.arrows);
    return std::move(reader.model);
}

} // namespace

const Scene& find_scene(const Model& model, const std::string& name)
{
    std::vector<std::string> known;
    for (const Scene& scene : model.scenes) {
        if (scene.name == (name.empty() ? "default" : name)) return scene;
        known.push_back(scene.name);
    }
    const SourceRange where{model.file, 0, 0};
    if (model.scenes.empty()) {
        throw ModelError("the model has no scene", where, "add [scene.default] with initial values and a duration");
    }
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
    for (const Parameter& parameter : model.parameters) out.push_back(parameter.symbol.name);
    for (const Symbol& symbol : model.base.coordinates) out.push_back(symbol.name);
    for (const Symbol& symbol : model.fibre.coordinates) out.push_back(symbol.name);
    if (is_nonholonomic(model))
        for (const Symbol& symbol : ambient_fibre(model))
            if (index_of(model.fibre.coordinates, symbol.name) == model.fibre.coordinates.size())
                out.push_back(symbol.name);
    if (model.control)
        for (const Symbol& symbol : model.control->controls) out.push_back(symbol.name);
    for (const Input& input : model.inputs) out.push_back(input.symbol.name);
    for (const FirstOrderState& state : model.states) out.push_back(state.symbol.name);
    return out;
}

} // namespace lagen
