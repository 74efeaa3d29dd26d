// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene_program.hpp"

#include "diagnostic.hpp"
#include "emit/print_header.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

/// Enough digits that the program reads the double nearest to the number.
std::string text_of(long double value)
{
    return fmt::format("{:.21g}", value);
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

std::string columns_text(const std::vector<TableColumn>& columns)
{
    std::string text;
    for (const TableColumn& column : columns)
        text += fmt::format("{}{}{}", text.empty() ? "" : ",", column.state ? 's' : 'o', column.index);
    return text.empty() ? "-" : text;
}

/// "INITIAL,MAX_DRIFT" of the invariant `name`.
Drift drift_of(std::string name, const std::string& value)
{
    const std::size_t comma = value.find(',');
    return {std::move(name), value.substr(0, comma), comma == std::string::npos ? "" : value.substr(comma + 1)};
}

void read_line(const std::string& key, const std::string& value, RunOutcome& outcome)
{
    constexpr std::string_view invariant = "invariant:";
    if (key == "status") outcome.status = value;
    if (key == "t") outcome.time = value;
    if (key == "state") {
        const std::vector<std::string_view> lanes = fields(value);
        if (lanes.size() != outcome.state.size()) throw InternalError("the program of a scene gave another state");
        for (std::size_t k = 0; k < lanes.size(); ++k) outcome.state[k].second = lanes[k];
    }
    if (key == "failed_at") outcome.failed_at = value;
    if (key == "steps") outcome.steps = value;
    if (key == "rejected") outcome.rejected = value;
    if (key == "rhs_calls") outcome.rhs_calls = value;
    if (key == "newton") outcome.newton = value;
    if (key == "decompositions") outcome.decompositions = value;
    if (key == "seconds") outcome.seconds = value;
    if (key == "event") {
        const std::size_t at = value.rfind('@');
        outcome.events.push_back({value.substr(0, at), at == std::string::npos ? "" : value.substr(at + 1)});
    }
    if (key == "energy" || key == "hamiltonian") outcome.invariants.push_back(drift_of(key, value));
    if (key.starts_with(invariant)) outcome.invariants.push_back(drift_of(key.substr(invariant.size()), value));
}

/// The column of an entry of the module's observables.
TableColumn observable(const KernelModule& module, const std::string& name)
{
    const std::vector<std::string>& names = kernel_named(module, "observables").outputs[0].entry_names;
    const auto entry = std::ranges::find(names, name);
    if (entry == names.end()) throw InternalError(fmt::format("'{}' is missing among the observables", name));
    return {name, false, static_cast<std::size_t>(entry - names.begin())};
}

} // namespace

std::string program_text(const std::string& name, const MethodEntry& method)
{
    return fmt::format(
        "#include \"model.hpp\"\n#include \"lagen_run/driver.hpp\"\nint main(int argc, char** argv)\n{{\n    return "
        "lagen::drive<lagen::models::{}<double>, lagen::{}>(argc, argv);\n}}\n",
        cpp_names({name})[0], method.type);
}

std::vector<TableColumn> columns_of(const KernelModule& module, const Scene& scene)
{
    std::vector<std::string> states;
    for (const Quantity& lane : lanes_of(module)) states.push_back(lane.name);
    std::vector<TableColumn> columns;
    if (!scene.observe) {
        for (std::size_t k = 0; k < states.size(); ++k) columns.push_back({states[k], true, k});
        if (has_kernel(module, "controls"))
            for (const std::string& name : kernel_named(module, "controls").outputs[0].entry_names)
                columns.push_back(observable(module, name));
        return columns;
    }
    for (const NamedTree& wanted : *scene.observe) {
        const auto state = std::find(states.begin(), states.end(), wanted.name);
        if (state == states.end())
            columns.push_back(observable(module, wanted.name));
        else
            columns.push_back({wanted.name, true, static_cast<std::size_t>(state - states.begin())});
    }
    return columns;
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
    switch (input.times.kind) {
    case Sampling::Kind::standard:
    case Sampling::Kind::count: give("--samples", std::to_string(input.times.count)); break;
    case Sampling::Kind::interval: give("--interval", text_of(*input.times.interval)); break;
    case Sampling::Kind::at: give("--at-file", input.at_file); break;
    }
    if (input.events != nullptr && !input.events->empty()) give("--events", events_of(*input.events));
    give("--columns", columns_text(input.columns));
    give("--report", input.report_file);
    return arguments;
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
    if (refused && outcome.steps == "0") outcome.invariants.clear();
}

} // namespace lagen
