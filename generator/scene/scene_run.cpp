// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/scene_run.hpp"

#include "kernels/form_kernels.hpp"
#include "kernels/non_finite.hpp"
#include "machine/write_file.hpp"
#include "model/model.hpp"
#include "model/scene_form.hpp"
#include "scene/integrate_scene.hpp"
#include "scene/read_input_table.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace lagen {

namespace {

// Walls of the domain: a condition a != b is left where a - b changes its sign, which may happen within one step. A
// run watches for it as for an event that stops it.

const std::string wall_name = "a wall of the domain"; ///< no name of an event in a model has spaces

bool moves(const Tree& condition, const Model& model)
{
    return std::ranges::any_of(names_in(condition), [&](const std::string& name) {
        return std::ranges::find(model.base.coordinates, name, &Symbol::name) != model.base.coordinates.end();
    });
}

/// The scene, and of a motion in continuous time with such an event for each wall that can move away
/// from the sign of its start; those of parameters alone cannot.
Scene with_walls(const Model& model, Scene scene)
{
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

/// A run that a wall has stopped has left the domain.
void call_walls(RunOutcome& outcome)
{
    const bool stopped =
        outcome.status == "stopped_by_event" && !outcome.events.empty() && outcome.events.back().name == wall_name;
    if (stopped) outcome.status = "left_domain";
    std::erase_if(outcome.events, [](const detail::FoundCrossing& event) { return event.name == wall_name; });
}

} // namespace

SceneRun::SceneRun(CheckedModel& checked, Scene scene, const MethodEntry& method, bool stretch)
    : checked_(checked), scene_(with_walls(checked.model, std::move(scene))), method_(method),
      preparation_(checked, scene_, method, run_driver)
{
    warn(checked.warnings);
    values_ = evaluate_scene(checked.model, scene_);
    parameters_ = finite_numbers(values_.parameters, scene_);
    input_.events = &scene_.events;
    input_.method_type = method.type;
    const auto decided = [this](bool needed) -> const CheckedModel& {
        return preparation_.checked(parameters_, needed);
    };
    start_.emplace(decided, scene_.form);
    preparation_.finish(parameters_, [&](const RunRecord& found) {
        input_.columns = columns_of(found.names, scene_);
        use_values(input_, scene_, values_, *start_, stretch);
        if (scene_.input_table)
            input_.held_inputs = read_input_table(checked_.model, scene_, values_, input_.times.end);
    });
}

std::string SceneRun::not_finite(const RunOutcome& outcome)
{
    const bool fails =
        outcome.status == "non_finite" || outcome.status == "step_too_small" || outcome.status == "newton_diverged";
    if (!fails || method_.kind != MethodKind::implicit_stages || values_.discrete) return {};
    const CheckedModel& checked = preparation_.checked(parameters_, true);
    KernelRequest request;
    request.form = form();
    request.only = {"rhs"};
    request.scene = &scene_;
    std::map<std::string, double> at{{"t", outcome.t}};
    for (std::size_t k = 0; k < outcome.state.size(); ++k) at[outcome.lanes[k]] = outcome.state[k];
    for (const auto* numbers : {&values_.parameters, &values_.inputs})
        for (const auto& [name, value] : *numbers) at[name] = static_cast<double>(value);
    return non_finite_entry(form_kernels(checked.model, checked.system, checked.report, request), at);
}

RunOutcome SceneRun::integrate(SecondRun second)
{
    RunOutcome outcome;
    outcome.model = checked_.model.name;
    outcome.scene = scene_.name;
    outcome.form = form();
    outcome.method = method_.name;
    outcome.energy_changes = record().energy_changes;
    outcome.searches = record().searches;
    outcome.branch = input_.branch.value_or(0);
    if (method_.adaptive && input_.absolute)
        outcome.absolute = fmt::format("{}", static_cast<double>(*input_.absolute));
    outcome.table.columns = {"t"};
    for (const TableColumn& column : input_.columns) outcome.table.columns.push_back(column.name);
    outcome.lanes = record().names.lanes;
    outcome.left_out = names_without_values(checked_.model, form());
    if (!is_uninterrupted([&] { integrate_scene(record().program, input_, outcome); })) return outcome;
    if (is_nonholonomic(checked_.model) && outcome.energy_changes) // reactions and drifts work on it: no invariant
        std::erase_if(outcome.invariants, is_energy);
    call_walls(outcome);
    outcome.not_finite = not_finite(outcome);
    judge_state({checked_.model, scene_, method_, record().program, input_, *start_}, second, outcome);
    return outcome;
}

} // namespace lagen
