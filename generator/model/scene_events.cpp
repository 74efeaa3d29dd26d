// SPDX-License-Identifier: GPL-2.0-or-later
/// The [scene.NAME.events] block, and what a discrete scene starts from: the first arrow g_0 of the groupoid, by its
/// group part `element` and its target `next`, or values of momenta or fibre coordinates in `initial`; and the number
/// of its steps.
#include "model/scene_reader.hpp"

#include "model/complaints.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

bool sets_one_of(const std::vector<NamedTree>& jump, const std::vector<Symbol>& symbols)
{
    return std::ranges::any_of(jump,
                               [&](const NamedTree& each) { return index_of(symbols, each.name) < symbols.size(); });
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
    const std::size_t state = index_of(state_symbols(reader.model), set.name);
    for (const Reconstruction& g : reader.model.reconstructions)
        if (g.holds(state))
            throw ModelError(
                fmt::format("the jump of {} sets '{}', an entry of a matrix of the group {}", title, set.name, g.group),
                set.where, "let it set fibre coordinates, which the matrix follows");
}

/// The values of coordinates, momenta and first-order states behind a crossing, as expressions of the state before it.
/// Throws ModelError: a name that is none of the state's, or held by a constraint or a group; fibre coordinates beside
/// momenta; a model with [control].
std::vector<NamedTree> read_jump(const ModelReader& reader, const Item& block, const std::string& title)
{
    const Model& model = reader.model;
    if (model.control)
        throw ModelError(
            fmt::format("{} has a 'jump', but the costates of [control] jump by the condition that the motion is the "
                        "best one",
                        title),
            block.where(), "leave the jump out, or the model without [control]");
    std::vector<NamedTree> jump =
        read_given(reader, block, settable_symbols(model), "coordinate, momentum or first-order state",
                   [&](const std::string& name) { return hint_for_key(settable_symbols(model), name, "coordinates"); });
    for (const NamedTree& each : jump) require_free(reader, each, title);
    if (sets_one_of(jump, model.fibre.coordinates) && sets_one_of(jump, model.fibre.momenta))
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

} // namespace

void read_scene_events(const ModelReader& reader, Scene& scene, const Item& block)
{
    constexpr std::size_t most_events = 1000;
    const std::vector<Item> items = block.items();
    if (items.size() > most_events)
        throw complain::too_many(fmt::format("scene '{}'", scene.name), items.size(), "events", most_events,
                                 block.where());
    for (const Item& item : items) {
        Event event = read_event(reader, item);
        const auto place = std::ranges::find(scene.events, event.name, &Event::name);
        if (place == scene.events.end())
            scene.events.push_back(std::move(event));
        else
            *place = std::move(event);
    }
}

namespace {

/// The keys that this model's scenes may have.
void require_discrete(const Model& model, const Item& item)
{
    if (!model.discrete) throw complain::needs(item.title(), "[discrete] of the model", item.where());
    if (item.name() == "element" && !model.groupoid->has_group())
        throw complain::takes_no("a scene on a pair groupoid", "element", item.where(),
                                 "give 'next', the target of the first arrow");
    if (item.name() == "next" && !model.groupoid->has_targets())
        throw complain::takes_no("a scene on this groupoid", "next", item.where(),
                                 "the target of an arrow follows from its 'element': leave it out");
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

} // namespace

void read_first_arrow(const ModelReader& reader, Scene& scene, const Item& block)
{
    const Item element = block.at("element"), next = block.at("next"), steps = block.at("steps");
    for (const Item& item : {element, next, steps})
        if (item) require_discrete(reader.model, item);
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

} // namespace lagen
