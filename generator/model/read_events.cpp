// SPDX-License-Identifier: GPL-2.0-or-later
/// The [scene.NAME.events] block.
#include "model/model_reader.hpp"

#include "model/read_jump.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

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
