// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/scene_program.hpp"

#include "commands/scene/scene_options.hpp"
#include "diagnostic.hpp"
#include "emit/print_header.hpp"
#include "model/scene_form.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace lagen {

namespace {

/// What the program reads as the double nearest to the number.
std::string text_of(long double value)
{
    return fmt::format("{}", static_cast<double>(value));
}

std::string list_of(const std::vector<long double>& values)
{
    std::string text;
    for (const long double value : values) text += (text.empty() ? "" : ",") + text_of(value);
    return text;
}

const char* direction_text(Direction direction)
{
    switch (direction) {
    case Direction::rising: return "rising";
    case Direction::falling: return "falling";
    case Direction::any: return "any";
    }
    return "any";
}

std::string events_of(const std::vector<Event>& events)
{
    std::string text;
    for (const Event& event : events)
        text += fmt::format("{}{}:{}:{}:{}", text.empty() ? "" : ",", event.name, direction_text(event.direction),
                            event.stop ? 1 : 0, event.count);
    return text;
}

std::string text_of_columns(const std::vector<TableColumn>& columns)
{
    std::string text;
    for (const TableColumn& column : columns)
        text += fmt::format("{}{}{}", text.empty() ? "" : ",", column.state ? 's' : 'o', column.index);
    return text.empty() ? "-" : text;
}

/// The line of a function that is followed, as driver.hpp describes it.
Drift drift_of(std::string name, const std::string& value)
{
    const std::vector<std::string_view> parts = fields(value);
    if (parts.size() != 7) throw InternalError("the program of a scene gave another figure");
    const auto part = [&](std::size_t k) { return std::string(parts[k]); };
    return {std::move(name), part(0), part(1), part(2), part(3), part(4), part(5), part(6)};
}

std::vector<std::string> numbers_of(const std::string& value)
{
    std::vector<std::string> numbers;
    if (!value.empty())
        for (const std::string_view each : fields(value)) numbers.emplace_back(each);
    return numbers;
}

/// "NAME@T@STATE", and "@STATE" behind its jump.
EventReport event_of(const std::string& value)
{
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= value.size();) {
        const std::size_t end = std::min(value.find('@', begin), value.size());
        parts.push_back(value.substr(begin, end - begin));
        begin = end + 1;
    }
    if (parts.size() < 3) throw InternalError("the program of a scene gave another event");
    return {parts[0], parts[1], numbers_of(parts[2]), numbers_of(parts.size() > 3 ? parts[3] : "")};
}

void read_line(const std::string& key, const std::string& value, RunOutcome& outcome)
{
    const std::pair<std::string_view, std::vector<Drift>*> followed[] = {
        {"invariant:", &outcome.invariants}, {"casimir:", &outcome.casimirs}, {"constraint:", &outcome.constraints}};
    if (key == "status") outcome.status = value;
    if (key == "t") outcome.time = value;
    if (key == "state") {
        const std::vector<std::string_view> lanes = fields(value);
        if (lanes.size() != outcome.state.size()) throw InternalError("the program of a scene gave another state");
        for (std::size_t k = 0; k < lanes.size(); ++k) outcome.state[k].second = lanes[k];
    }
    if (key == "below") { // "LANE:MOST"
        const std::size_t colon = value.find(':');
        const auto lane = static_cast<std::size_t>(std::strtoull(value.c_str(), nullptr, 10));
        outcome.below_absolute.push_back({outcome.state.at(lane).first, value.substr(colon + 1)});
    }
    if (key == "failed_at") outcome.failed_at = value;
    if (key == "branches") outcome.branches = numbers_of(value);
    if (key == "others") outcome.others = numbers_of(value);
    if (key == "steps") outcome.steps = value;
    if (key == "rejected") outcome.rejected = value;
    if (key == "rhs_calls") outcome.rhs_calls = value;
    if (key == "newton") outcome.newton = value;
    if (key == "decompositions") outcome.decompositions = value;
    if (key == "seconds") outcome.seconds = value;
    if (key == "event") outcome.events.push_back(event_of(value));
    if (key == "starts_on") outcome.starts_on.push_back(value);
    if (key == "balance") outcome.balance.push_back(drift_of("energy less work", value));
    if (key == "work") outcome.work = value;
    if (key == "energy" || key == "hamiltonian") outcome.invariants.push_back(drift_of(key, value));
    for (const auto& [prefix, drifts] : followed)
        if (key.starts_with(prefix)) drifts->push_back(drift_of(key.substr(prefix.size()), value));
    if (key == "manifold") {
        const std::size_t comma = value.find(',');
        outcome.manifold = value.substr(0, comma);
        outcome.manifold_time = value.substr(comma + 1);
    }
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

/// At times, or by their number.
void give_rows(const ProgramInput& input, const std::function<void(const char*, std::string)>& give)
{
    switch (input.times.kind) {
    case Sampling::Kind::event: give("--at-event", input.times.event); break;
    case Sampling::Kind::standard:
    case Sampling::Kind::count: give("--samples", std::to_string(input.times.count)); break;
    case Sampling::Kind::interval: give("--interval", text_of(*input.times.interval)); break;
    case Sampling::Kind::at: give("--at-file", input.at_file); break;
    }
}

} // namespace

std::string program_text(const Driver& driver, const std::string& name, const MethodEntry& method, bool reversible)
{
    const std::string type = reversible ? fmt::format("Reversible<lagen::{}>", method.type) : method.type;
    return fmt::format(
        "#include \"model.hpp\"\n#include \"{}/driver.hpp\"\nint main(int argc, char** argv)\n{{\n    return "
        "lagen::{}<lagen::models::{}<double>, lagen::{}>(argc, argv);\n}}\n",
        driver.folder, driver.function, cpp_names({name})[0], type);
}

std::string model_text(const std::string& name, bool packs)
{
    return fmt::format("#include \"lagen/export_model.hpp\"\n#include \"model.hpp\"\n{}(lagen::models::{})\n",
                       packs ? "LAGEN_EXPORT_MODEL_WITH_PACKS" : "LAGEN_EXPORT_MODEL", cpp_names({name})[0]);
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
    for (const std::vector<NamedNumber>* group : {&values.base, &values.fibre, &values.momenta, &values.states})
        (void)finite_numbers(*group, scene);
    input.times = sample_times(scene, values, input.columns.size() + 1, stretch);
    input.initial = start(values);
    input.from_arrow = starts_from_arrow(values);
    if (values.own_step) input.parameters.push_back(*values.step);
    if (!values.discrete) input.step = values.step;
    input.relative = values.relative.value_or(standard_tolerance);
    input.absolute = values.absolute.value_or(standard_tolerance);
}

std::string events_text(const ProgramInput& input)
{
    return input.events == nullptr ? "" : events_of(*input.events);
}

std::string columns_text(const ProgramInput& input)
{
    return text_of_columns(input.columns);
}

std::vector<std::string> watch_arguments(const ProgramInput& input)
{
    std::vector<std::string> arguments;
    if (std::string events = events_text(input); !events.empty()) arguments = {"--events", std::move(events)};
    arguments.insert(arguments.end(), {"--columns", columns_text(input)});
    return arguments;
}

std::vector<std::string> program_arguments(const std::string& program, const ProgramInput& input)
{
    std::vector<std::string> arguments{program,
                                       "--initial",
                                       list_of(input.initial),
                                       "--start",
                                       text_of(input.times.start),
                                       "--end",
                                       text_of(input.times.end)};
    const auto give = [&](const char* name, std::string value) {
        arguments.insert(arguments.end(), {name, std::move(value)});
    };
    if (!input.parameters.empty()) give("--parameters", list_of(input.parameters));
    if (input.step) give("--step", text_of(*input.step));
    if (input.relative) give("--relative", text_of(*input.relative));
    if (input.absolute) give("--absolute", text_of(*input.absolute));
    if (input.most_steps) give("--max-steps", std::to_string(*input.most_steps));
    if (!input.held_inputs.empty()) give("--inputs", input.inputs_file);
    if (input.from_arrow) give("--from", "arrow");
    if (input.branch) give("--branch", std::to_string(*input.branch));
    if (input.times.every > 0)
        give("--every", std::to_string(input.times.every));
    else
        give_rows(input, give);
    const std::vector<std::string> watched = watch_arguments(input);
    arguments.insert(arguments.end(), watched.begin(), watched.end());
    give("--report", input.report_file);
    return arguments;
}

void require_started(const ProcessResult& result, const std::string& program)
{
    if (result.started) return;
    throw MachineError(
        fmt::format("error: the compiled scene could not be started: {}\nhint: remove '{}' to have it compiled again",
                    result.error, program));
}

void refuse_end(const ProcessResult& result, const std::string& rest)
{
    throw MachineError(
        fmt::format("error: the compiled scene ended with exit code {}\n{}", result.exit_code, result.error + rest));
}

void read_report(const std::string& text, RunOutcome& outcome)
{
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        const std::size_t equals = line.find('=');
        if (equals != std::string::npos) read_line(line.substr(0, equals), line.substr(equals + 1), outcome);
        begin = end + 1;
    }
    if (outcome.status.empty()) throw InternalError("the program of a scene gave no report");
    // A run that was refused at its start has measured nothing.
    const bool refused = outcome.status == "not_separable" || outcome.status == "invalid_input" ||
                         outcome.status == "singular_mass_matrix";
    if (!refused || outcome.steps != "0") return;
    for (auto* drifts : {&outcome.invariants, &outcome.balance, &outcome.casimirs, &outcome.constraints})
        drifts->clear();
    outcome.manifold.clear();
}

} // namespace lagen
