// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/domain_walls.hpp"

#include "model/scene_form.hpp"

#include <algorithm>

namespace lagen {
namespace {

const std::string wall_name = "a wall of the domain"; ///< no name of an event in a model has spaces

bool moves(const Tree& condition, const Model& model)
{
    return std::ranges::any_of(names_in(condition), [&](const std::string& name) {
        return std::ranges::find(model.base.coordinates, name, &Symbol::name) != model.base.coordinates.end();
    });
}

} // namespace

Scene with_walls(const Model& model, Scene scene)
{
    scene.form = form_of(model, scene);
    if (form_named(scene.form).steps) return scene;
    for (const Tree& condition : model.base.domain) {
        if (condition->comparison != Comparison::not_equal || !moves(condition, model)) continue;
        Event wall;
        wall.name = wall_name;
        wall.when = add({condition->arguments[0], negate(condition->arguments[1])});
        wall.stop = true;
        scene.events.push_back(std::move(wall));
    }
    return scene;
}

void call_walls(RunOutcome& outcome)
{
    const bool stopped =
        outcome.status == "stopped_by_event" && !outcome.events.empty() && outcome.events.back().name == wall_name;
    if (stopped) outcome.status = "left_domain";
    std::erase_if(outcome.events, [](const detail::FoundCrossing& event) { return event.name == wall_name; });
}

} // namespace lagen
