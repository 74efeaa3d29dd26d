// SPDX-License-Identifier: GPL-2.0-or-later
/// The [scene.NAME] blocks: what each starts from, its options, numbers, sampling and columns. `like` is resolved here:
/// a scene starts as a copy of the one that it is like.
#include "model/scene_reader.hpp"

#include "expression/functions.hpp"
#include "expression/parse.hpp"
#include "model/complaints.hpp"
#include "model/dependency_order.hpp"
#include "model/read_curve.hpp"
#include "model/read_values.hpp"
#include "model/scene_form.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_map>

namespace lagen {

namespace {

// Scenes are copied along 'like', so their sizes are bounded.
constexpr std::size_t most_scenes = 200;
constexpr std::size_t most_times = 100'000;
constexpr std::size_t most_columns = 4096;

bool is_among(const std::vector<Symbol>& symbols, const std::string& name)
{
    return index_of(symbols, name) < symbols.size();
}

/// The hint at the coordinate that was meant by another name.
std::string hint_for_start(const ModelReader& reader, const std::string& unknown)
{
    const Model& model = reader.model;
    std::string hint;
    if (std::ranges::find(reader.rates, unknown, &CoordinateRate::rate) != reader.rates.end())
        hint = fmt::format("it follows from the fibre coordinates: {}",
                           comma_list(declared_names(model.fibre.coordinates)));
    else if (!model.control && !is_nonholonomic(model))
        hint = hint_for_rate(unknown, reader.rates);
    if (hint.empty()) hint = hint_for_momentum(unknown, reader.rates);
    return hint.empty() ? hint_for_key(settable_symbols(model), unknown, "coordinates") : hint;
}

void read_initial(const ModelReader& reader, Scene& scene, const Item& block)
{
    const Model& model = reader.model;
    std::vector<NamedTree> own = read_given(reader, block, settable_symbols(model), "coordinate of the model",
                                            [&](const std::string& name) { return hint_for_start(reader, name); });
    const auto gives = [&](const std::vector<Symbol>& lanes) {
        return std::ranges::any_of(own, [&](const NamedTree& each) { return is_among(lanes, each.name); });
    };
    const auto drop = [&](const std::vector<Symbol>& given, const std::vector<Symbol>& other) {
        if (!gives(given) || gives(other)) return;
        std::erase_if(scene.initial, [&](const NamedTree& each) { return is_among(other, each.name); });
    };
    drop(model.fibre.momenta, model.fibre.coordinates);
    drop(model.fibre.coordinates, model.fibre.momenta);
    put_all(scene.initial, std::move(own));
}

void read_scene_inputs(const ModelReader& reader, Scene& scene, const Item& item)
{
    const std::vector<Symbol> symbols = input_symbols(reader.model);
    if (symbols.empty())
        throw complain::needs(item.title(), "[inputs] of the model", item.where(), "[inputs] u = 0, and u in [forces]");
    if (item.is(TomlKind::string)) {
        scene.inputs.clear();
        scene.input_table = InputTable{item.text(), item.value().where};
        return;
    }
    scene.input_table.reset();
    put_all(scene.inputs, read_given(reader, item, symbols, "input"));
}

/// `initial` has every base coordinate, and every fibre coordinate or every momentum.
void require_complete(const ModelReader& reader, const Scene& scene)
{
    const std::set<std::string> given = given_names(scene.initial);
    const Fibre& fibre = reader.model.fibre;
    const Missing no_fibre = missing_of(fibre.coordinates, given);
    const Missing no_momentum = missing_of(fibre.momenta, given);
    const bool some_fibre = no_fibre.count < fibre.coordinates.size();
    const bool some_momenta = no_momentum.count < fibre.momenta.size();
    if (some_fibre && some_momenta) {
        throw ModelError(fmt::format("scene '{}' mixes fibre coordinates and momenta in 'initial'", scene.name),
                         scene.where, "give every fibre coordinate or every momentum");
    }
    Missing missing = missing_of(reader.model.base.coordinates, given);
    const bool momenta = some_momenta || is_form(form_of(reader.model, scene), FormKind::pontryagin);
    const Missing& rest = momenta ? no_momentum : no_fibre;
    if (!scene.rest || momenta) missing.add(rest);
    if (missing.count == 0) return;
    const bool fibre_left_out = rest.count > 0 && !momenta && !scene.rest;
    const bool costate_sought = momenta && reader.model.control && reader.model.control->boundary;
    throw complain::leaves_out(
        fmt::format("scene '{}'", scene.name),
        fmt::format("the initial value{} of {}", missing.count > 1 ? "s" : "", missing.text()), scene.where,
        fibre_left_out   ? "rest = true sets the fibre coordinates left out to zero"
        : costate_sought ? "nothing solves [control.boundary] yet: a run starts from all coordinates and momenta"
                         : "");
}

void read_observe(const ModelReader& reader, Scene& scene, const Item& item)
{
    std::vector<NamedTree> out;
    scene.states.reset();
    std::set<std::string> seen{"t"}; // the column t is always there
    const auto add = [&](NamedTree column) {
        if (seen.insert(column.name).second) out.push_back(std::move(column));
    };
    for (const Excerpt& text : item.texts()) {
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
    if (out.size() > most_columns)
        throw complain::too_many(item.title(), out.size(), "columns", most_columns, item.value().where);
    scene.observe = std::move(out);
}

/// The event of the scene that `sample` names, if it names one.
const Event* sampled_event(const ModelReader& reader, const Scene& scene, const Item& item)
{
    const std::string& text = item.text();
    if (!item.is(TomlKind::string) || !is_identifier(text)) return nullptr;
    const auto event = std::ranges::find(scene.events, text, &Event::name);
    const Scope& scope = reader.model.scope;
    const bool stands = scope.has_symbol(text) || scope.has_definition(text) || scope.find_size(text);
    if (event != scene.events.end() && !stands) return &*event;
    if (event != scene.events.end())
        throw ModelError(fmt::format("{} is '{}', which is an event and a name of the model", item.title(), text),
                         item.value().where, "rename the event");
    if (stands || is_reserved_name(text)) return nullptr;
    std::vector<std::string> known;
    for (const Event& each : scene.events) known.push_back(each.name);
    for (const std::string& parameter : reader.names.of(Role::parameter)) known.push_back(parameter);
    throw complain::unknown_word(item.title(), text, item.value().where, known, "events and parameters");
}

void read_sampling(const ModelReader& reader, Scene& scene, const Item& block)
{
    const Item sample = block.at("sample"), samples = block.at("samples"), at = block.at("at");
    if (!sample && !samples && !at) return;
    scene.sampling = Sampling{};
    if (const Event* event = sample ? sampled_event(reader, scene, sample) : nullptr) {
        scene.sampling.kind = Sampling::Kind::event;
        scene.sampling.event = event->name;
        scene.sampling.event_where = sample.value().where;
    } else if (sample) {
        scene.sampling.kind = Sampling::Kind::interval;
        scene.sampling.interval = reader.scalar(sample);
    } else if (samples) {
        scene.sampling.kind = Sampling::Kind::count;
        scene.sampling.count = static_cast<std::size_t>(samples.value().integer);
    } else {
        scene.sampling.kind = Sampling::Kind::at;
        const std::vector<TomlValue>& times = at.value().items;
        if (times.size() > most_times)
            throw complain::too_many(at.title(), times.size(), "times", most_times, at.value().where);
        const std::string what = "a time in " + at.title();
        for (const TomlValue& time : times)
            scene.sampling.at.push_back(reader.scalar(read_expression(time, what), Role::parameter, what));
    }
}

void read_options(const ModelReader& reader, Scene& scene, const Item& block)
{
    const std::pair<const char*, Tree Scene::*> numbers[] = {
        {"start", &Scene::start},          {"duration", &Scene::duration}, {"step", &Scene::step},
        {"tolerance", &Scene::tolerance},  {"relative", &Scene::relative}, {"absolute", &Scene::absolute},
        {"time_scale", &Scene::time_scale}};
    if (block.at("tolerance")) scene.relative = scene.absolute = nullptr;
    if (block.at("relative") || block.at("absolute")) scene.tolerance = nullptr;
    for (const auto& [key, member] : numbers)
        if (const Item item = block.at(key)) scene.*member = reader.scalar(item);
    if (const Item item = block.at("time_scale")) scene.time_scale_where = item.value().where;
    if (const Item item = block.at("rest")) scene.rest = item.value().boolean;
    if (const Item item = block.at("project")) scene.project = item.value().boolean;
    if (const Item item = block.at("method")) {
        scene.method = item.text();
        scene.method_where = item.value().where;
    }
    if (const Item item = block.at("form")) {
        scene.form = item.text();
        scene.form_where = item.value().where;
        require_form(reader.model, scene.form, item.title(), scene.form_where);
    }
}

/// Throws ModelError where the scene's parameter values close a cycle.
void require_acyclic_scene(const ModelReader& reader, const Scene& scene)
{
    if (scene.parameters.empty()) return;
    std::vector<NamedTree> values;
    for (const Parameter& each : reader.model.parameters)
        values.push_back({each.symbol.name, each.value, each.symbol.where});
    put_all(values, scene.parameters);
    (void)dependency_order(values, "parameters");
}

} // namespace

void put_all(std::vector<NamedTree>& list, std::vector<NamedTree> entries)
{
    std::unordered_map<std::string, std::size_t> index; // looked up, never iterated
    for (std::size_t k = 0; k < list.size(); ++k) index.emplace(list[k].name, k);
    for (NamedTree& entry : entries) {
        const auto [place, fresh] = index.try_emplace(entry.name, list.size());
        if (fresh) {
            list.push_back(std::move(entry));
        } else {
            list[place->second] = std::move(entry);
        }
    }
}

std::vector<Symbol> settable_symbols(const Model& model)
{
    std::vector<Symbol> all;
    for (const std::vector<Symbol>& symbols :
         {model.base.coordinates, model.fibre.coordinates, model.fibre.momenta, state_symbols(model)})
        all.insert(all.end(), symbols.begin(), symbols.end());
    return all;
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

void Missing::add(const Missing& more)
{
    count += more.count;
    names.insert(names.end(), more.names.begin(), more.names.end());
}

std::string Missing::text() const
{
    constexpr std::size_t most = 20;
    if (names.size() <= most) return comma_list(names);
    const std::vector<std::string> first(names.begin(), names.begin() + most);
    return fmt::format("{} and {} more", comma_list(first), names.size() - most);
}

Missing missing_of(const std::vector<Symbol>& symbols, const std::set<std::string>& given)
{
    Missing out;
    for (const SymbolGroup& group : group_symbols(symbols)) {
        Missing of_group;
        for (std::size_t k = 0; k < group.shape.size(); ++k) {
            const std::string& name = symbols[group.first + k].name;
            if (!given.contains(name)) of_group.names.push_back(name);
        }
        of_group.count = of_group.names.size();
        if (of_group.count == group.shape.size()) of_group.names = {group.name};
        out.add(of_group);
    }
    return out;
}

std::set<std::string> given_names(const std::vector<NamedTree>& entries)
{
    std::set<std::string> names;
    for (const NamedTree& each : entries) names.insert(each.name);
    return names;
}

Scene read_scene(const ModelReader& reader, Scene scene, const Item& block)
{
    scene.name = block.name();
    scene.where = block.where();
    read_options(reader, scene, block);
    if (const Item initial = block.at("initial")) read_initial(reader, scene, initial);
    read_first_arrow(reader, scene, block);
    put_all(scene.parameters, read_given(reader, block.at("parameters"), parameter_symbols(reader.model), "parameter"));
    if (const Item inputs = block.at("inputs")) read_scene_inputs(reader, scene, inputs);
    if (const Item observe = block.at("observe")) read_observe(reader, scene, observe);
    if (const Item events = block.at("events")) read_scene_events(reader, scene, events);
    read_sampling(reader, scene, block);
    for (const Setting& setting : *reader.settings) {
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

namespace {

/// The scene blocks by name, and which of them are read already.
struct SceneBlocks {
    std::vector<Item> items;
    std::vector<std::string> names;
    std::vector<std::optional<Scene>> done;
};

/// The index of the scene that `k` is like, if it is like one.
std::optional<std::size_t> liked_by(const SceneBlocks& blocks, std::size_t k)
{
    const Item like = blocks.items[k].at("like");
    if (!like) return std::nullopt;
    const auto found = std::ranges::find(blocks.names, like.text());
    if (found == blocks.names.end())
        throw complain::names_no(like.title(), like.text(), "scene", like.value().where,
                                 hint_for(like.text(), blocks.names, "scenes"));
    return static_cast<std::size_t>(found - blocks.names.begin());
}

/// Scene `first` and everything that it is like, the last of the chain first.
void read_chain(const ModelReader& reader, SceneBlocks& blocks, std::size_t first)
{
    std::vector<std::size_t> chain;
    std::optional<std::size_t> next = first;
    while (next && !blocks.done[*next]) {
        if (std::ranges::find(chain, *next) != chain.end())
            throw complain::like_itself(blocks.items[*next].title(), blocks.items[*next].where());
        chain.push_back(*next);
        next = liked_by(blocks, *next);
    }
    Scene scene;
    if (next) scene = *blocks.done[*next];
    for (; !chain.empty(); chain.pop_back()) {
        const Item& block = blocks.items[chain.back()];
        saying_which(block.name(), [&] { scene = read_scene(reader, std::move(scene), block); });
        blocks.done[chain.back()] = scene;
    }
}

} // namespace

void saying_which(const std::string& scene, const std::function<void()>& read)
{
    try {
        read();
    } catch (const ModelError& error) {
        Diagnostic diagnostic = error.diagnostic();
        const std::string& message = diagnostic.message;
        const bool says = message.find("scene '" + scene + "'") != std::string::npos ||
                          message.find("[scene." + scene) != std::string::npos;
        if (says) throw;
        diagnostic.message = fmt::format("scene '{}': {}", scene, diagnostic.message);
        throw ModelError(diagnostic);
    }
}

void read_scenes(ModelReader& reader)
{
    const Item block = reader.at("scene");
    SceneBlocks blocks{block.items(), {}, {}};
    if (blocks.items.size() > most_scenes)
        throw complain::too_many("the model", blocks.items.size(), "scenes", most_scenes, block.where());
    for (const Item& item : blocks.items) {
        require_printable(item.key(), "a scene's name");
        if (item.name().empty()) throw ModelError("a scene has an empty name", item.where());
        blocks.names.push_back(item.name());
    }
    blocks.done.resize(blocks.items.size());
    for (std::size_t k = 0; k < blocks.items.size(); ++k) read_chain(reader, blocks, k);
    for (std::optional<Scene>& scene : blocks.done) reader.model.scenes.push_back(std::move(*scene));
    read_plots(reader, blocks.items);
}

} // namespace lagen
