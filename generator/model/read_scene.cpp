// SPDX-License-Identifier: GPL-2.0-or-later
/// The [scene.NAME] blocks. `like` is resolved here: a scene starts as a copy of the one that it is like.
#include "model/model_reader.hpp"

#include "expression/parse.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

Tree over_parameters(const ModelReader& reader, const TomlValue& value, const std::string& what)
{
    return reader.close(read_expression(value, what), {Role::parameter}, what);
}

/// Replaces the entry of the same name or appends.
void put(std::vector<NamedTree>& list, NamedTree entry)
{
    const auto same = [&](const NamedTree& other) { return other.name == entry.name; };
    const auto place = std::find_if(list.begin(), list.end(), same);
    if (place == list.end()) {
        list.push_back(std::move(entry));
    } else {
        *place = std::move(entry);
    }
}

bool has_role(const ModelReader& reader, const std::string& name, Role role)
{
    const Names::Entry* entry = reader.names.find(name);
    return entry != nullptr && entry->role == role;
}

void read_initial(const ModelReader& reader, Scene& scene, const TomlEntry& block)
{
    const TableReader table(block.value, fmt::format("'initial' of scene '{}'", scene.name));
    std::vector<NamedTree> own;
    for (const TomlEntry& entry : block.value.entries) {
        const Names::Entry* declared = reader.names.find(entry.name());
        const bool state = declared != nullptr && (declared->role == Role::base || declared->role == Role::fibre ||
                                                   declared->role == Role::momentum);
        if (!state) {
            std::vector<std::string> known = reader.names.of(Role::base);
            for (const Role role : {Role::fibre, Role::momentum}) {
                const std::vector<std::string> more = reader.names.of(role);
                known.insert(known.end(), more.begin(), more.end());
            }
            throw ModelError(
                fmt::format("scene '{}' gives an initial value to '{}', which is no coordinate of the model",
                            scene.name, entry.name()),
                entry.where(), hint_for(entry.name(), known, "coordinates"));
        }
        const std::string what = fmt::format("the initial value of '{}'", entry.name());
        own.push_back(NamedTree{entry.name(), over_parameters(reader, entry.value, what), entry.where()});
    }
    const auto gives = [&](Role role) {
        return std::any_of(own.begin(), own.end(),
                           [&](const NamedTree& each) { return has_role(reader, each.name, role); });
    };
    for (const auto& [given, other] : {std::pair{Role::momentum, Role::fibre}, {Role::fibre, Role::momentum}}) {
        if (!gives(given) || gives(other)) continue;
        std::erase_if(scene.initial,
                      [&, role = other](const NamedTree& each) { return has_role(reader, each.name, role); });
    }
    for (NamedTree& entry : own) put(scene.initial, std::move(entry));
}

void read_scene_parameters(const ModelReader& reader, Scene& scene, const TomlEntry& block)
{
    const TableReader table(block.value, fmt::format("'parameters' of scene '{}'", scene.name));
    for (const TomlEntry& entry : block.value.entries) {
        if (!has_role(reader, entry.name(), Role::parameter)) {
            throw ModelError(
                fmt::format("scene '{}' sets '{}', which is no parameter of the model", scene.name, entry.name()),
                entry.where(), hint_for(entry.name(), reader.names.of(Role::parameter), "parameters"));
        }
        const std::string what = fmt::format("the value of parameter '{}'", entry.name());
        put(scene.parameters, NamedTree{entry.name(), over_parameters(reader, entry.value, what), entry.where()});
    }
}

void read_observe(const ModelReader& reader, Scene& scene, const TomlEntry& entry)
{
    std::vector<NamedTree> out;
    std::set<std::string> seen{"t"}; // the column t is always there
    const auto add = [&](NamedTree column) {
        if (seen.insert(column.name).second) out.push_back(std::move(column));
    };
    for (const Excerpt& text : read_list(entry.value, fmt::format("'observe' of scene '{}'", scene.name))) {
        const SourceRange where = text.range(0, text.text.size());
        if (text.text == "state" && reader.names.find("state") == nullptr) {
            const Fibre& fibre = reader.model.fibre;
            for (const Symbol& symbol : reader.model.base.coordinates)
                add({symbol.name, name(symbol.name, where), where});
            for (const Symbol& symbol : scene.form == "hamilton" ? fibre.momenta : fibre.coordinates) {
                add({symbol.name, name(symbol.name, where), where});
            }
            continue;
        }
        const Excerpt inner = trimmed(text, 0, text.text.size());
        add({inner.text, reader.close_observed(parse_expression(text)), where});
    }
    scene.observe = std::move(out);
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
    if (given->name() == "sample") {
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
    Tree tolerance, relative, absolute;
    const bool one = take("tolerance", tolerance);
    const bool two = take("relative", relative) | take("absolute", absolute);
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

void read_options(Scene& scene, TableReader& table)
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
        const std::vector<std::string> forms{"lagrange", "hamilton", "pontryagin", "discrete"};
        if (std::find(forms.begin(), forms.end(), scene.form) == forms.end()) {
            throw ModelError(fmt::format("{} is '{}', which is no form", text("form"), scene.form), entry->value.where,
                             hint_for(scene.form, forms, "forms"));
        }
    }
}

/// Every base coordinate, and every fibre coordinate or every momentum.
void require_complete(const ModelReader& reader, const Scene& scene)
{
    std::set<std::string> given;
    for (const NamedTree& each : scene.initial) given.insert(each.name);
    const auto missing_of = [&](const std::vector<Symbol>& symbols) {
        std::vector<std::string> out;
        for (const Symbol& symbol : symbols) {
            if (!given.contains(symbol.name)) out.push_back(symbol.name);
        }
        return out;
    };
    const Fibre& fibre = reader.model.fibre;
    const std::vector<std::string> no_fibre = missing_of(fibre.coordinates);
    const std::vector<std::string> no_momentum = missing_of(fibre.momenta);
    const bool some_fibre = no_fibre.size() < fibre.coordinates.size();
    const bool some_momenta = no_momentum.size() < fibre.momenta.size();
    if (some_fibre && some_momenta) {
        throw ModelError(fmt::format("scene '{}' mixes fibre coordinates and momenta in 'initial'", scene.name),
                         scene.where, "give every fibre coordinate or every momentum");
    }
    std::vector<std::string> missing = missing_of(reader.model.base.coordinates);
    const std::vector<std::string>& rest = some_momenta ? no_momentum : no_fibre;
    if (!scene.rest || some_momenta) missing.insert(missing.end(), rest.begin(), rest.end());
    if (missing.empty()) return;
    const bool fibre_left_out = !rest.empty() && !some_momenta;
    throw ModelError(fmt::format("scene '{}' leaves out the initial value{} of {}", scene.name,
                                 missing.size() > 1 ? "s" : "", comma_list(missing)),
                     scene.where, fibre_left_out ? "rest = true sets the fibre coordinates left out to zero" : "");
}

void require_acyclic_scene(const ModelReader& reader, const Scene& scene)
{
    if (scene.parameters.empty()) return;
    std::vector<NamedTree> values;
    for (const Parameter& parameter : reader.model.parameters) {
        values.push_back(NamedTree{parameter.symbol.name, parameter.value, parameter.symbol.where});
    }
    for (const NamedTree& own : scene.parameters) put(values, own);
    require_acyclic(values);
}

Scene read_scene(const ModelReader& reader, Scene scene, const TomlEntry& block, const std::vector<Setting>& settings)
{
    scene.name = block.name();
    scene.where = block.where();
    TableReader table(block.value, fmt::format("[scene.{}]", scene.name));
    table.refuse_later({"element", "next", "steps"});
    (void)table.take("like");
    read_options(scene, table);
    read_numbers(reader, scene, table);
    if (const TomlEntry* entry = table.take("initial")) read_initial(reader, scene, *entry);
    if (const TomlEntry* entry = table.take("parameters")) read_scene_parameters(reader, scene, *entry);
    if (const TomlEntry* entry = table.take("observe")) read_observe(reader, scene, *entry);
    read_sampling(reader, scene, table);
    if (const TomlEntry* entry = table.take("events")) read_scene_events(reader, scene, *entry);
    table.finish();
    for (const Setting& setting : settings) {
        std::erase_if(scene.parameters, [&](const NamedTree& each) { return each.name == setting.name; });
    }
    require_acyclic_scene(reader, scene);
    require_complete(reader, scene);
    return scene;
}

} // namespace

void read_scenes(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings)
{
    if (block == nullptr) return;
    constexpr long most_scenes = 1000;
    const TableReader table(block->value, "[scene]");
    const std::vector<TomlEntry>& entries = block->value.entries;
    if (entries.size() > most_scenes) {
        throw ModelError(fmt::format("the model has {} scenes, more than {}", entries.size(), most_scenes),
                         block->where());
    }
    std::vector<std::string> known;
    std::map<std::string, std::size_t> index;
    for (std::size_t k = 0; k < entries.size(); ++k) {
        if (entries[k].name().empty() ||
            read_text(TomlValue{TomlKind::string, entries[k].where(), entries[k].key, 0, false, true, {}, {}},
                      "a scene's name")
                .empty()) {
            throw ModelError("a scene has an empty name", entries[k].where());
        }
        known.push_back(entries[k].name());
        index.emplace(entries[k].name(), k);
    }
    std::vector<std::optional<Scene>> done(entries.size());
    for (std::size_t first = 0; first < entries.size(); ++first) {
        std::vector<std::size_t> chain; // the scene, what it is like, what that is like, ...
        std::optional<std::size_t> next = first;
        Scene scene;
        while (next && !done[*next]) {
            const std::size_t k = *next;
            if (std::find(chain.begin(), chain.end(), k) != chain.end()) {
                throw ModelError(fmt::format("scene '{}' is like itself, through 'like'", known[k]),
                                 entries[k].where());
            }
            chain.push_back(k);
            TableReader fields(entries[k].value, fmt::format("[scene.{}]", known[k]));
            const TomlEntry* like = fields.take("like");
            next.reset();
            if (like == nullptr) continue;
            const std::string target = read_text(like->value, fmt::format("'like' of scene '{}'", known[k]));
            if (!index.contains(target)) {
                throw ModelError(fmt::format("scene '{}' is like '{}', which is no scene", known[k], target),
                                 like->value.where, hint_for(target, known, "scenes"));
            }
            next = index.at(target);
        }
        if (next) scene = *done[*next];
        for (; !chain.empty(); chain.pop_back()) {
            scene = read_scene(reader, scene, entries[chain.back()], settings);
            done[chain.back()] = scene;
        }
    }
    for (const std::optional<Scene>& scene : done) reader.model.scenes.push_back(*scene);
}

} // namespace lagen
