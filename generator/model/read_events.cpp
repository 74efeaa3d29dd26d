// SPDX-License-Identifier: GPL-2.0-or-later
/// The [scene.NAME.events] block.
#include "expression/parse_family.hpp"
#include "model/families.hpp"
#include "model/model_reader.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

// The key `jump` of an event.

bool stands_in(const std::vector<NamedTree>& jump, const std::vector<Symbol>& symbols)
{
    return std::ranges::any_of(jump,
                               [&](const NamedTree& each) { return index_of(symbols, each.name) < symbols.size(); });
}

[[noreturn]] void refuse_name(const ModelReader& reader, const TomlEntry& entry, const std::string& title)
{
    std::vector<std::string> known = declared_names(reader.model.base.coordinates);
    for (const std::vector<std::string>& more :
         {declared_names(reader.model.fibre.coordinates), declared_names(reader.model.fibre.momenta),
          declared_names(state_symbols(reader.model))})
        known.insert(known.end(), more.begin(), more.end());
    throw ModelError(fmt::format("the jump of {} sets '{}', which is no coordinate, momentum or first-order state",
                                 title, entry.name()),
                     entry.where(), hint_for(entry.name(), known, "coordinates"));
}

/// Refuses a name that nothing but the motion itself may change.
void require_free(const ModelReader& reader, const std::string& name, const TomlEntry& entry, const std::string& title)
{
    for (const Tree& constraint : reader.model.base.constraints) {
        if (!mentions(constraint, name)) continue;
        throw ModelError(fmt::format("the jump of {} sets '{}', which the constraint {} = 0 holds", title, name,
                                     to_text(constraint)),
                         entry.where(), "let it set fibre coordinates or momenta");
    }
    const std::size_t state = index_of(state_symbols(reader.model), name);
    for (const Reconstruction& g : reader.model.reconstructions)
        if (g.holds(state))
            throw ModelError(
                fmt::format("the jump of {} sets '{}', an entry of a matrix of the group {}", title, name, g.group),
                entry.where(), "let it set fibre coordinates, which the matrix follows");
}

/// The values of coordinates, momenta and first-order states behind a crossing, as expressions of the state before it.
/// `title` names the event in messages. Throws ModelError: a name that is none of the state's, given twice, or held by
/// a constraint or a group; fibre coordinates beside momenta; a model with [control].
std::vector<NamedTree> read_jump(const ModelReader& reader, const TomlEntry& block, const std::string& title)
{
    const TableReader table(block.value, "'jump' of " + title);
    const Model& model = reader.model;
    if (model.control)
        throw ModelError(
            fmt::format("{} has a 'jump', but the costates of [control] jump by the condition that the motion is the "
                        "best one",
                        title),
            block.where(), "leave the jump out, or the model without [control]");
    const std::vector<Symbol> states = state_symbols(model);
    std::vector<NamedTree> jump;
    for (const TomlEntry& entry : block.value.entries) {
        bool found = false;
        for (const auto* symbols : {&model.base.coordinates, &model.fibre.coordinates, &model.fibre.momenta, &states}) {
            const std::optional<ResolvedKey> key = resolve_key(*symbols, entry_key(entry.key, model.scope));
            if (!key || found) continue;
            found = true;
            const std::string what = fmt::format("'{}' in the jump of {}", key->name, title);
            const ArrayValue closed = reader.observer.close_array(read_array_expression(entry.value, what), true);
            const std::vector<Tree> values = fit_values(closed, key->shape, what, entry.value.where);
            for (std::size_t k = 0; k < values.size(); ++k) {
                const std::string& name = (*symbols)[key->indices[k]].name;
                require_free(reader, name, entry, title);
                if (std::ranges::find(jump, name, &NamedTree::name) != jump.end())
                    throw ModelError(fmt::format("the jump of {} sets '{}' twice", title, name), entry.where(),
                                     "keep one of them");
                jump.push_back({name, values[k], entry.where()});
            }
        }
        if (!found) refuse_name(reader, entry, title);
    }
    if (stands_in(jump, model.fibre.coordinates) && stands_in(jump, model.fibre.momenta))
        throw ModelError(fmt::format("the jump of {} sets fibre coordinates and momenta", title), block.where(),
                         "keep one kind: each follows from the other");
    return jump;
}

Direction read_direction(const TomlEntry& entry, const std::string& what)
{
    const std::string text = read_text(entry.value, what);
    if (text == "rising") return Direction::rising;
    if (text == "falling") return Direction::falling;
    if (text == "any") return Direction::any;
    throw ModelError(fmt::format("{} is '{}'", what, text), entry.value.where,
                     hint_for(text, {"rising", "falling", "any"}, "directions"));
}

Event read_event(const ModelReader& reader, const TomlEntry& entry)
{
    require_identifier(entry.name(), entry.where(), "the name of an event");
    Event event;
    event.name = entry.name();
    event.where = entry.where();
    const std::string title = fmt::format("event '{}'", event.name);
    TableReader table(entry.value, title);
    const TomlEntry* when = table.take("when");
    if (const TomlEntry* field = table.take("direction")) {
        event.direction = read_direction(*field, "'direction' of " + title);
    }
    if (const TomlEntry* field = table.take("stop")) event.stop = read_flag(field->value, "'stop' of " + title);
    if (const TomlEntry* field = table.take("count")) {
        event.count = read_count(field->value, "'count' of " + title, 1, 1'000'000'000);
    }
    if (const TomlEntry* field = table.take("jump")) event.jump = read_jump(reader, *field, title);
    table.finish();
    if (when == nullptr) {
        throw ModelError(title + " has no key 'when'", event.where, "when = \"an expression that crosses zero\"");
    }
    if (when->value.kind == TomlKind::string) refuse_equation(when->value.text, "the condition");
    event.when = reader.close_observed(read_expression(when->value, "'when' of " + title));
    return event;
}

} // namespace

void read_scene_events(const ModelReader& reader, Scene& scene, const TomlEntry& block)
{
    const TableReader table(block.value, fmt::format("[scene.{}.events]", scene.name));
    constexpr std::size_t most_events = 1000;
    if (block.value.entries.size() > most_events) {
        throw ModelError(
            fmt::format("scene '{}' has {} events, more than {}", scene.name, block.value.entries.size(), most_events),
            block.where());
    }
    for (const TomlEntry& entry : block.value.entries) {
        Event event = read_event(reader, entry);
        const auto same = [&](const Event& other) { return other.name == event.name; };
        const auto place = std::find_if(scene.events.begin(), scene.events.end(), same);
        if (place == scene.events.end()) {
            scene.events.push_back(std::move(event));
        } else {
            *place = std::move(event);
        }
    }
}

} // namespace lagen
