// SPDX-License-Identifier: GPL-2.0-or-later
/// One [scene.NAME] block: its options, numbers, sampling and columns.
#include "model/scene_reader.hpp"

#include "expression/functions.hpp"
#include "expression/parse.hpp"
#include "model/families.hpp"
#include "model/read_curve.hpp"
#include "model/read_values.hpp"
#include "model/scene_form.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

// Scenes are copied along 'like', so their sizes are bounded.
constexpr std::size_t most_times = 100'000;
constexpr std::size_t most_columns = 4096;

void read_observe(const ModelReader& reader, Scene& scene, const TomlEntry& entry)
{
    std::vector<NamedTree> out;
    scene.states.reset();
    std::set<std::string> seen{"t"}; // the column t is always there
    const auto add = [&](NamedTree column) {
        if (seen.insert(column.name).second) out.push_back(std::move(column));
    };
    for (const Excerpt& text : read_list(entry.value, fmt::format("'observe' of scene '{}'", scene.name))) {
        const SourceRange where = text.range(0, text.text.size());
        if (text.text == "state" && reader.names.find("state") == nullptr) {
            const std::size_t first = out.size();
            for (const std::string& state : state_names(reader.model, form_of(reader.model, scene)))
                add({state, name(state, where), where});
            if (!scene.states) scene.states = StateColumns{first, out.size() - first, where};
            continue;
        }
        for (NamedTree& column : observed_columns(reader.model, reader.arrows, text)) add(std::move(column));
    }
    if (out.size() > most_columns) {
        throw ModelError(fmt::format("'observe' of scene '{}' asks for {} columns, more than {}", scene.name,
                                     out.size(), most_columns),
                         entry.value.where);
    }
    scene.observe = std::move(out);
}

/// The event of the scene that `sample` names, if it names one.
const Event* sampled_event(const ModelReader& reader, const Scene& scene, const TomlValue& value)
{
    const std::string& text = value.text.text;
    if (value.kind != TomlKind::string || !is_identifier(text)) return nullptr;
    const auto event = std::ranges::find(scene.events, text, &Event::name);
    const Scope& scope = reader.model.scope;
    const bool stands = scope.has_symbol(text) || scope.has_definition(text) || scope.find_size(text);
    if (event != scene.events.end()) {
        if (!stands) return &*event;
        throw ModelError(
            fmt::format("'sample' of scene '{}' is '{}', which is an event and a name of the model", scene.name, text),
            value.where, "rename the event");
    }
    if (stands || is_reserved_name(text)) return nullptr;
    std::vector<std::string> known;
    for (const Event& each : scene.events) known.push_back(each.name);
    for (const std::string& parameter : reader.names.of(Role::parameter)) known.push_back(parameter);
    throw ModelError(fmt::format("'sample' of scene '{}' is '{}', which is neither an event of the scene nor a "
                                 "parameter",
                                 scene.name, text),
                     value.where, hint_for(text, known, "events and parameters"));
}

void read_sampling(const ModelReader& reader, Scene& scene, TableReader& table)
{
    const std::string of = fmt::format(" of scene '{}'", scene.name);
    const TomlEntry* given = nullptr;
    for (const char* key : {"sample", "samples", "at"}) {
        const TomlEntry* entry = table.take(key);
        if (entry == nullptr) continue;
        if (given != nullptr) {
            throw ModelError(
                fmt::format("scene '{}' gives both '{}' and '{}'", scene.name, given->name(), entry->name()),
                entry->where(), "keep one of sample, samples and at");
        }
        given = entry;
    }
    if (given == nullptr) return;
    scene.sampling = Sampling{};
    if (const Event* event = given->name() == "sample" ? sampled_event(reader, scene, given->value) : nullptr) {
        scene.sampling.kind = Sampling::Kind::event;
        scene.sampling.event = event->name;
        scene.sampling.event_where = given->value.where;
    } else if (given->name() == "sample") {
        scene.sampling.kind = Sampling::Kind::interval;
        scene.sampling.interval = over_parameters(reader, given->value, "'sample'" + of);
    } else if (given->name() == "samples") {
        scene.sampling.kind = Sampling::Kind::count;
        scene.sampling.count = static_cast<std::size_t>(read_count(given->value, "'samples'" + of, 2, 10'000'000));
    } else {
        scene.sampling.kind = Sampling::Kind::at;
        if (given->value.kind != TomlKind::array) {
            throw ModelError(
                fmt::format("'at'{} is {}, where an array of times is required", of, kind_text(given->value.kind)),
                given->value.where);
        }
        if (given->value.items.size() > most_times) {
            throw ModelError(
                fmt::format("'at'{} lists {} times, more than {}", of, given->value.items.size(), most_times),
                given->value.where);
        }
        for (const TomlValue& time : given->value.items) {
            scene.sampling.at.push_back(over_parameters(reader, time, "a time in 'at'" + of));
        }
    }
}

void read_numbers(const ModelReader& reader, Scene& scene, TableReader& table)
{
    const auto take = [&](const char* key, Tree& place) {
        const TomlEntry* entry = table.take(key);
        if (entry == nullptr) return false;
        place = over_parameters(reader, entry->value, fmt::format("'{}' of scene '{}'", key, scene.name));
        return true;
    };
    take("start", scene.start);
    take("duration", scene.duration);
    take("step", scene.step);
    if (const TomlEntry* entry = table.take("time_scale")) {
        const std::string what = fmt::format("'time_scale' of scene '{}'", scene.name);
        scene.time_scale = reader.observer.close(read_expression(entry->value, what));
        scene.time_scale_where = entry->value.where;
    }
    Tree tolerance, relative, absolute;
    const bool one = take("tolerance", tolerance);
    const bool has_relative = take("relative", relative);
    const bool has_absolute = take("absolute", absolute);
    const bool two = has_relative || has_absolute;
    if (one && two) {
        throw ModelError(fmt::format("scene '{}' gives 'tolerance' and also 'relative' or 'absolute'", scene.name),
                         scene.where, "'tolerance' means both; keep it or the other two");
    }
    if (one) {
        scene.tolerance = tolerance;
        scene.relative = scene.absolute = nullptr;
    }
    if (two) scene.tolerance = nullptr;
    if (relative) scene.relative = relative;
    if (absolute) scene.absolute = absolute;
}

void read_options(const Model& model, Scene& scene, TableReader& table)
{
    const auto text = [&](const char* key) { return fmt::format("'{}' of scene '{}'", key, scene.name); };
    if (const TomlEntry* entry = table.take("rest")) scene.rest = read_flag(entry->value, text("rest"));
    if (const TomlEntry* entry = table.take("project")) scene.project = read_flag(entry->value, text("project"));
    if (const TomlEntry* entry = table.take("method")) {
        scene.method = read_text(entry->value, text("method"));
        scene.method_where = entry->value.where;
    }
    if (const TomlEntry* entry = table.take("form")) {
        scene.form = read_text(entry->value, text("form"));
        scene.form_where = entry->value.where;
        require_form(model, scene.form, text("form"), scene.form_where);
    }
}

} // namespace

Tree over_parameters(const ModelReader& reader, const TomlValue& value, const std::string& what)
{
    return reader.close(read_expression(value, what), {Role::parameter}, what);
}

Scene read_scene(const ModelReader& reader, Scene scene, const TomlEntry& block, const std::vector<Setting>& settings)
{
    scene.name = block.name();
    scene.where = block.where();
    TableReader table(block.value, fmt::format("[scene.{}]", scene.name));
    (void)table.take("like");
    (void)table.take("plot"); // read_plots
    read_options(reader.model, scene, table);
    read_numbers(reader, scene, table);
    if (const TomlEntry* entry = table.take("initial")) read_initial(reader, scene, *entry);
    read_first_arrow(reader, scene, table);
    if (const TomlEntry* entry = table.take("parameters")) read_scene_parameters(reader, scene, *entry);
    if (const TomlEntry* entry = table.take("inputs")) read_scene_inputs(reader, scene, *entry);
    if (const TomlEntry* entry = table.take("observe")) read_observe(reader, scene, *entry);
    if (const TomlEntry* entry = table.take("events")) read_scene_events(reader, scene, *entry);
    read_sampling(reader, scene, table);
    table.finish();
    for (const Setting& setting : settings) {
        if (!setting.gives_value()) continue;
        const std::string key = key_of(reader, setting);
        std::erase_if(scene.parameters, [&](const NamedTree& each) { return names_entry(key, each.name); });
    }
    require_acyclic_scene(reader, scene);
    const std::string form_of_scene = form_of(reader.model, scene);
    if (!forms_of(reader.model).empty()) {
        std::string form = scene.form;
        scene = in_form(reader.model, std::move(scene), form_of_scene);
        scene.form = std::move(form);
    }
    if (form_named(form_of_scene).steps)
        require_first_arrow(reader, scene);
    else
        require_complete(reader, scene);
    return scene;
}

} // namespace lagen
