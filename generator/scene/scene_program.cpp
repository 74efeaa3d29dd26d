// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/scene_program.hpp"

#include "emit/print_header.hpp"
#include "model/scene_form.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

detail::RowsAsked rows_asked(const ProgramInput& input)
{
    using Kind = detail::RowsAsked::Kind;
    const SampleTimes& times = input.times;
    if (times.every > 0) return {Kind::every, times.every, 0, {}};
    switch (times.kind) {
    case Sampling::Kind::event:
        return {Kind::event,
                static_cast<std::size_t>(std::ranges::find(*input.events, times.event, &Event::name) -
                                         input.events->begin()),
                0,
                {}};
    case Sampling::Kind::standard:
    case Sampling::Kind::count: break;
    case Sampling::Kind::interval: return {Kind::interval, 0, static_cast<double>(times.interval.value_or(0)), {}};
    case Sampling::Kind::at: return {Kind::at, 0, 0, doubles_of(times.at)};
    }
    return {Kind::count, times.count, 0, {}};
}

/// The place of `name` among `names`, or their number.
std::size_t place_of(const std::vector<std::string>& names, const std::string& name)
{
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

/// The column of an entry of the observables.
TableColumn observable(const TableNames& names, const std::string& name)
{
    const std::size_t entry = place_of(names.observables, name);
    if (entry == names.observables.size())
        throw InternalError(fmt::format("'{}' is missing among the observables", name));
    return {name, false, entry};
}

std::vector<std::string> entries_of(const KernelModule& module, const char* kernel)
{
    if (!has_kernel(module, kernel)) return {};
    return kernel_named(module, kernel).outputs[0].entry_names;
}

} // namespace

std::string main_text(const std::vector<std::string>& headers, const std::string& call)
{
    std::string text;
    for (const std::string& header : headers) text += fmt::format("#include \"{}\"\n", header);
    return text + fmt::format("int main(int argc, char** argv)\n{{\n    return lagen::{};\n}}\n", call);
}

std::string program_text(const Driver& driver, const std::string& name, const MethodEntry& method, bool reversible)
{
    const std::string type = reversible ? fmt::format("Reversible<lagen::{}>", method.type) : method.type;
    return main_text(
        {"model.hpp", std::string(driver.folder) + "/driver.hpp"},
        fmt::format("{}<lagen::models::{}<double>, lagen::{}>(argc, argv)", driver.function, class_name(name), type));
}

std::string model_text(const std::string& name, bool packs)
{
    return fmt::format("#include \"lagen/export_model.hpp\"\n#include \"model.hpp\"\n{}(lagen::models::{})\n",
                       packs ? "LAGEN_EXPORT_MODEL_WITH_PACKS" : "LAGEN_EXPORT_MODEL", class_name(name));
}

TableNames names_of(const Model& model, const KernelModule& module)
{
    TableNames names{{}, entries_of(module, "observables"), state_names(model, module.form)};
    for (const Quantity& lane : lanes_of(module)) names.lanes.push_back(lane.name);
    return names;
}

std::vector<TableColumn> columns_named(const TableNames& names, const std::vector<std::string>& wanted)
{
    std::vector<TableColumn> columns;
    for (const std::string& name : wanted) {
        const std::size_t lane = place_of(names.lanes, name);
        columns.push_back(lane == names.lanes.size() ? observable(names, name) : TableColumn{name, true, lane});
    }
    return columns;
}

std::vector<TableColumn> columns_of(const TableNames& names, const Scene& scene)
{
    if (!scene.observe) return columns_named(names, names.states);
    std::vector<std::string> wanted;
    for (const NamedTree& column : *scene.observe) wanted.push_back(column.name);
    return columns_named(names, wanted);
}

void use_values(ProgramInput& input, const Scene& scene, const SceneValues& values, StartState& start, bool stretch)
{
    input.parameters = finite_numbers(values.parameters, scene);
    input.initial = finite_start(start, values, scene);
    input.times = sample_times(scene, values, input.columns.size() + 1, stretch);
    input.from_arrow = starts_from_arrow(values);
    if (values.own_step) input.parameters.push_back(*values.step);
    if (!values.discrete) input.step = values.step;
    input.relative = values.relative.value_or(standard_tolerance);
    input.absolute = values.absolute.value_or(standard_tolerance);
}

std::vector<double> doubles_of(const std::vector<long double>& values)
{
    return {values.begin(), values.end()};
}

std::vector<detail::EventAsked> events_asked(const std::vector<Event>& events)
{
    std::vector<detail::EventAsked> asked;
    for (const Event& event : events) {
        const int direction = event.direction == Direction::rising ? 1 : event.direction == Direction::falling ? -1 : 0;
        asked.push_back({event.name, direction, event.stop, static_cast<std::size_t>(event.count)});
    }
    return asked;
}

detail::RunJob job_of(const ProgramInput& input)
{
    detail::RunJob job;
    job.parameters = doubles_of(input.parameters);
    job.initial = doubles_of(input.initial);
    job.start = static_cast<double>(input.times.start);
    job.end = static_cast<double>(input.times.end);
    job.step = static_cast<double>(input.step.value_or(0));
    if (input.relative) job.relative = static_cast<double>(*input.relative);
    if (input.absolute) job.absolute = static_cast<double>(*input.absolute);
    job.max_steps = input.most_steps.value_or(0);
    job.from_arrow = input.from_arrow;
    job.branch = input.branch.value_or(0);
    job.rows = rows_asked(input);
    for (const std::vector<double>& row : input.held_inputs)
        job.input_rows.insert(job.input_rows.end(), row.begin(), row.end());
    if (input.events != nullptr) job.events = events_asked(*input.events);
    for (const TableColumn& column : input.columns) job.columns.push_back({!column.state, column.index});
    return job;
}

void require_started(const ProcessResult& result, const std::string& program)
{
    if (result.started) return;
    throw MachineError(fmt::format("the compiled scene could not be started: {}", result.error),
                       fmt::format("remove '{}' to have it compiled again", program));
}

void refuse_end(const ProcessResult& result, const std::string& rest)
{
    throw MachineError(
        fmt::format("the compiled scene ended with exit code {}\n{}", result.exit_code, result.error + rest));
}

} // namespace lagen
