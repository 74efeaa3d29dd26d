// SPDX-License-Identifier: GPL-2.0-or-later
/// The [scene.NAME] blocks: what each starts from, its options, numbers, sampling and columns. `like` is resolved here:
/// a scene starts as a copy of the one that it is like. Behind them the events, and what a discrete scene starts from:
/// the first arrow g_0 of the groupoid, by its group part `element` and its target `next`, or values of momenta or
/// fibre coordinates in `initial`; and the number of its steps.
#include "expression/functions.hpp"
#include "expression/parse.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_curve.hpp"
#include "model/read_values.hpp"
#include "model/scene_form.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <unordered_map>

namespace lagen {

namespace {

constexpr std::size_t most_columns = 4096; // of a scene: they are copied along 'like'

/// Base coordinates, fibre coordinates, momenta and first-order states: what a start and a jump may set.
std::vector<Symbol> settable_symbols(const Model& model)
{
    return symbols_of(model, Role::base | Role::fibre | Role::momentum | Role::state);
}

/// Symbols without a value; a family that has none at all by its name.
struct Missing {
    std::size_t count = 0; ///< of symbols
    std::vector<std::string> names;

    void add(const Missing& more)
    {
        count += more.count;
        names.insert(names.end(), more.names.begin(), more.names.end());
    }
    [[nodiscard]] std::string text() const
    {
        constexpr std::size_t most = 20;
        if (names.size() <= most) return comma_list(names);
        return fmt::format("{} and {} more", comma_list(part_of(names, 0, most)), names.size() - most);
    }
};

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
    const auto drop = [&](const std::vector<Symbol>& given, const std::vector<Symbol>& other) {
        if (first_of(own, given) == nullptr || first_of(own, other) != nullptr) return;
        std::erase_if(scene.initial, [&](const NamedTree& each) { return index_of(other, each.name) < other.size(); });
    };
    drop(model.fibre.momenta, model.fibre.coordinates);
    drop(model.fibre.coordinates, model.fibre.momenta);
    put_all(scene.initial, std::move(own));
}

void read_scene_inputs(const ModelReader& reader, Scene& scene, const Item& item)
{
    const std::vector<Symbol> symbols = symbols_of(reader.model, Role::input);
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
    if (some_fibre && some_momenta)
        throw ModelError(fmt::format("scene '{}' mixes fibre coordinates and momenta in 'initial'", scene.name),
                         scene.where, "give every fibre coordinate or every momentum");
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
        const SourceRange where = place_of(text);
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
        const std::string what = "a time in " + at.title();
        for (const TomlValue& time : at.value().items)
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

/// The fibre coordinates that a scene at rest leaves out are 0; one that starts from momenta or an arrow has none.
void at_rest(const Model& model, Scene& scene)
{
    const auto is_momentum = [&](const NamedTree& each) {
        return index_of(model.fibre.momenta, each.name) < model.fibre.momenta.size();
    };
    if (!scene.rest || !scene.element.empty() || !scene.next.empty() || std::ranges::any_of(scene.initial, is_momentum))
        return;
    const std::set<std::string> given = given_names(scene.initial);
    for (const Symbol& symbol : model.fibre.coordinates)
        if (!given.contains(symbol.name)) scene.initial.push_back({symbol.name, number(0), scene.where});
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

/// Refuses a name that nothing but the motion itself may change.
void require_free(const ModelReader& reader, const NamedTree& set, const std::string& title)
{
    for (const Tree& constraint : reader.model.base.constraints) {
        if (!mentions(constraint, set.name)) continue;
        throw ModelError(fmt::format("the jump of {} sets '{}', which the constraint {} = 0 holds", title, set.name,
                                     to_text(constraint)),
                         set.where, "let it set fibre coordinates or momenta");
    }
    const std::size_t state = index_of(symbols_of(reader.model, Role::state), set.name);
    for (const Reconstruction& g : reader.model.reconstructions)
        if (g.holds(state))
            throw ModelError(
                fmt::format("the jump of {} sets '{}', an entry of a matrix of the group {}", title, set.name, g.group),
                set.where, "let it set fibre coordinates, which the matrix follows");
}

/// The values of coordinates, momenta and first-order states behind a crossing, as expressions of the state before it.
/// Throws ModelError: a name that is none of the state's, or held by a constraint or a group; fibre coordinates beside
/// momenta.
std::vector<NamedTree> read_jump(const ModelReader& reader, const Item& block, const std::string& title)
{
    const Model& model = reader.model;
    std::vector<NamedTree> jump =
        read_given(reader, block, settable_symbols(model), "coordinate, momentum or first-order state",
                   [&](const std::string& name) { return hint_for_key(settable_symbols(model), name, "coordinates"); });
    for (const NamedTree& each : jump) require_free(reader, each, title);
    if (first_of(jump, model.fibre.coordinates) != nullptr && first_of(jump, model.fibre.momenta) != nullptr)
        throw ModelError(fmt::format("the jump of {} sets fibre coordinates and momenta", title), block.where(),
                         "keep one kind: each follows from the other");
    return jump;
}

Event read_event(const ModelReader& reader, const Item& item)
{
    require_identifier(item.name(), item.where(), "the name of an event");
    Event event;
    event.name = item.name();
    event.where = item.where();
    if (const Item direction = item.at("direction"))
        event.direction = direction.text() == "rising"    ? Direction::rising
                          : direction.text() == "falling" ? Direction::falling
                                                          : Direction::any;
    if (const Item stop = item.at("stop")) event.stop = stop.value().boolean;
    if (const Item count = item.at("count")) event.count = count.value().integer;
    if (const Item jump = item.at("jump")) event.jump = read_jump(reader, jump, item.title());
    const Item when = item.at("when");
    if (when.is(TomlKind::string)) refuse_equation(when.value().text, "the condition");
    event.when = reader.scalar(when);
    return event;
}

void read_scene_events(const ModelReader& reader, Scene& scene, const Item& block)
{
    for (const Item& item : block.items()) {
        Event event = read_event(reader, item);
        const auto place = std::ranges::find(scene.events, event.name, &Event::name);
        (place == scene.events.end() ? scene.events.emplace_back() : *place) = std::move(event);
    }
}

[[noreturn]] void refuse_missing(const Scene& scene, const char* what, const Missing& missing)
{
    throw complain::leaves_out(fmt::format("scene '{}'", scene.name),
                               fmt::format("the {} value{} of {}", what, missing.count > 1 ? "s" : "", missing.text()),
                               scene.where);
}

/// The parts of an arrow that its kind has.
void require_parts(const ModelReader& reader, const Scene& scene)
{
    const GroupoidBlock& groupoid = *reader.model.groupoid;
    if (groupoid.has_group() && scene.element.empty())
        throw complain::leaves_out(fmt::format("scene '{}'", scene.name),
                                   "'element', the group part of its first arrow", scene.where);
    if (!groupoid.has_targets()) return;
    const Missing missing = missing_of(reader.model.base.coordinates, given_names(scene.next));
    if (missing.count > 0) refuse_missing(scene, "next", missing);
}

/// `element`, `next` and `steps`.
void read_first_arrow(const ModelReader& reader, Scene& scene, const Item& block)
{
    const Item element = block.at("element"), next = block.at("next"), steps = block.at("steps");
    if (element) {
        const ArrayValue closed = reader.array(element);
        const Shape& wanted = reader.model.groupoid->generators[0].shape;
        if (!(closed.shape == wanted))
            throw complain::is_not(element.title(), to_text(closed.shape), to_text(wanted), element.value().where,
                                   "it is a matrix of the group of the groupoid");
        scene.element = closed.entries;
        scene.element_where = element.value().where;
    }
    put_all(scene.next, read_given(reader, next, reader.model.base.coordinates, "base coordinate"));
    if (steps) scene.steps = steps.value().integer;
}

/// In a discrete scene: throws ModelError unless `initial` has every base coordinate, and the first arrow is given, or
/// every momentum, or (where there is a Lagrangian) every fibre coordinate.
void require_first_arrow(const ModelReader& reader, const Scene& scene)
{
    const Model& model = reader.model;
    const std::set<std::string> given = given_names(scene.initial);
    const Missing no_base = missing_of(model.base.coordinates, given);
    const Missing no_fibre = missing_of(model.fibre.coordinates, given);
    const Missing no_momenta = missing_of(model.fibre.momenta, given);
    const bool fibre = no_fibre.count < model.fibre.coordinates.size();
    const bool momenta = no_momenta.count < model.fibre.momenta.size();
    const bool arrow = !scene.element.empty() || !scene.next.empty();
    if (no_base.count > 0) refuse_missing(scene, "initial", no_base);
    if ((arrow && (fibre || momenta)) || (fibre && momenta))
        throw ModelError(fmt::format("scene '{}' starts from {} at once", scene.name,
                                     arrow ? "an arrow and from values of the fibre" : "fibre coordinates and momenta"),
                         scene.where, "give the first arrow, or every momentum, or every fibre coordinate");
    if (arrow) return require_parts(reader, scene);
    if (momenta && no_momenta.count > 0) refuse_missing(scene, "initial", no_momenta);
    if (momenta) return;
    const std::string first = model.groupoid->kind == GroupoidKind::pair     ? "'next'"
                              : model.groupoid->kind == GroupoidKind::atiyah ? "'next' and 'element'"
                                                                             : "'element'";
    if (!fibre && !scene.rest)
        throw ModelError(fmt::format("scene '{}' gives neither its first arrow ({}) nor momenta", scene.name, first),
                         scene.where, "an arrow is the first step; momenta determine it");
    if (!model.lagrangian)
        throw ModelError(
            fmt::format("scene '{}' starts from fibre coordinates, which give momenta by [lagrangian] alone",
                        scene.name),
            scene.where, fmt::format("give {}, or momenta in 'initial'", first));
    if (!scene.rest && no_fibre.count > 0) refuse_missing(scene, "initial", no_fibre);
}

/// The scene of `block`, on top of `scene` (empty, or the scene that it is like). Parameters set on the command line
/// win over the scene's.
Scene read_scene(const ModelReader& reader, Scene scene, const Item& block)
{
    scene.name = block.name();
    scene.where = block.where();
    read_options(reader, scene, block);
    if (const Item initial = block.at("initial")) read_initial(reader, scene, initial);
    read_first_arrow(reader, scene, block);
    put_all(scene.parameters,
            read_given(reader, block.at("parameters"), symbols_of(reader.model, Role::parameter), "parameter"));
    if (const Item inputs = block.at("inputs")) read_scene_inputs(reader, scene, inputs);
    if (const Item observe = block.at("observe")) read_observe(reader, scene, observe);
    if (const Item events = block.at("events")) read_scene_events(reader, scene, events);
    read_sampling(reader, scene, block);
    for (const Setting& setting : *reader.settings) {
        if (!setting.gives_value() || setting.sizes_alone) continue;
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

/// Scenes, or their pictures, each made once. `make` asks for what a block is like before it reads the block itself.
template <class Made>
class Likes {
  public:
    using Make = std::function<Made(Likes&, const Item&)>;

    /// `noun` stands before the titles of the blocks in messages.
    Likes(const std::vector<Item>& blocks, std::string noun, Make make)
        : blocks_(blocks), noun_(std::move(noun)), make_(std::move(make))
    {
        for (const Item& block : blocks) names_.push_back(block.name());
    }

    const Made& of(const std::string& name)
    {
        const auto [place, fresh] = made_.try_emplace(name);
        std::optional<Made>& made = place->second;
        const Item& block = blocks_[static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin())];
        if (!fresh && !made) throw complain::like_itself(noun_ + block.title(), block.where());
        if (fresh) made = make_(*this, block);
        return *made;
    }

    /// The same for the scene that a key `like` names.
    const Made& of(const Item& like)
    {
        if (std::ranges::find(names_, like.text()) == names_.end())
            throw complain::names_no(like.title(), like.text(), "scene", like.value().where,
                                     hint_for(like.text(), names_, "scenes"));
        return of(like.text());
    }

  private:
    const std::vector<Item>& blocks_;
    std::string noun_;
    Make make_;
    std::vector<std::string> names_;
    std::map<std::string, std::optional<Made>> made_; ///< nothing where it is being made
};

/// Runs `read`. A mistake in any scene keeps the whole model from being read, so that its message says which it is.
template <class Read>
auto saying_which(const std::string& scene, Read read)
{
    try {
        return read();
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

/// A scene without a picture of its own has that of the scene which it is like.
std::optional<Plot> picture_of(const ModelReader& reader, Likes<std::optional<Plot>>& plots, const Item& scene)
{
    const Item block = scene.at("plot"), like = (block ? block : scene).at("like");
    if (!block) return like ? plots.of(like) : std::nullopt;
    const std::optional<Plot> liked = like ? plots.of(like) : Plot{};
    if (!liked)
        throw complain::needs("the plot of " + scene.title(), fmt::format("one of scene '{}'", like.text()),
                              like.value().where, fmt::format("add [scene.{}.plot] with curves", like.text()));
    return saying_which(scene.name(), [&] { return read_plot(reader, *liked, block); });
}

} // namespace

const NamedTree* first_of(const std::vector<NamedTree>& entries, const std::vector<Symbol>& symbols)
{
    const auto is_among = [&](const NamedTree& each) { return index_of(symbols, each.name) < symbols.size(); };
    const auto found = std::ranges::find_if(entries, is_among);
    return found == entries.end() ? nullptr : &*found;
}

void put_all(std::vector<NamedTree>& list, std::vector<NamedTree> entries)
{
    std::unordered_map<std::string, std::size_t> index; // looked up, never iterated
    for (std::size_t k = 0; k < list.size(); ++k) index.emplace(list[k].name, k);
    for (NamedTree& entry : entries) {
        const auto [place, fresh] = index.try_emplace(entry.name, list.size());
        (fresh ? list.emplace_back() : list[place->second]) = std::move(entry);
    }
}

void read_scenes(ModelReader& reader)
{
    const std::vector<Item> blocks = reader.at("scene").items();
    for (const Item& item : blocks) {
        require_printable(item.key(), "a scene's name");
        if (item.name().empty()) throw ModelError("a scene has an empty name", item.where());
    }
    Likes<Scene> scenes(blocks, "", [&](Likes<Scene>& others, const Item& item) {
        const Item like = item.at("like");
        Scene scene = like ? others.of(like) : Scene{};
        return saying_which(item.name(), [&] { return read_scene(reader, std::move(scene), item); });
    });
    for (const Item& item : blocks) {
        reader.model.scenes.push_back(scenes.of(item.name()));
        at_rest(reader.model, reader.model.scenes.back()); // behind all that are like it
    }
    Likes<std::optional<Plot>> plots(blocks, "the plot of ",
                                     [&](auto& others, const Item& item) { return picture_of(reader, others, item); });
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        Scene& scene = reader.model.scenes[k];
        scene.plot = plots.of(blocks[k].name());
        if (scene.plot && !forms_of(reader.model).empty())
            require_values_in(reader.model, scene, form_of(reader.model, scene));
    }
}

} // namespace lagen
