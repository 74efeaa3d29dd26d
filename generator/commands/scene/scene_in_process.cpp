// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/scene_in_process.hpp"

#include "commands/machine/interrupt_flag.hpp"
#include "diagnostic.hpp"
#include "methods/integrate_compiled.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

std::vector<double> doubles_of(const std::vector<long double>& values)
{
    std::vector<double> rounded;
    for (const long double value : values) rounded.push_back(static_cast<double>(value));
    return rounded;
}

void give_times(const SampleTimes& times, detail::DriveArguments& given)
{
    given.start = static_cast<double>(times.start);
    given.end = static_cast<double>(times.end);
    if (times.every > 0) {
        given.every = times.every;
        return;
    }
    switch (times.kind) {
    case Sampling::Kind::event: given.at_event = times.event; break;
    case Sampling::Kind::standard:
    case Sampling::Kind::count: given.samples = times.count; break;
    case Sampling::Kind::interval: given.interval = static_cast<double>(*times.interval); break;
    case Sampling::Kind::at: given.at = doubles_of(times.at); break;
    }
}

/// What the run is told.
detail::DriveArguments arguments_of(const ProgramInput& input)
{
    detail::DriveArguments given;
    const auto rounded = [](const std::optional<long double>& value) {
        return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
    };
    given.parameters = doubles_of(input.parameters);
    given.initial = doubles_of(input.initial);
    given.step = rounded(input.step);
    given.relative = rounded(input.relative);
    given.absolute = rounded(input.absolute);
    if (input.most_steps) given.max_steps = *input.most_steps;
    give_times(input.times, given);
    for (const std::vector<double>& row : input.held_inputs)
        given.input_rows.insert(given.input_rows.end(), row.begin(), row.end());
    given.events = events_text(input);
    given.columns = columns_text(input);
    return given;
}

} // namespace

bool is_compiled_model(const std::string& path)
{
    return path.ends_with(".so");
}

bool integrate_in_process(const std::string& path, const ProgramInput& input,
                          const std::function<void(std::string_view)>& rows, RunOutcome& outcome)
{
    const InterruptFlag interrupt;
    const CompiledRun run = integrate_compiled(path, input.method_type, arguments_of(input), rows, interrupt.flag());
    if (!run.not_loaded.empty())
        throw MachineError(fmt::format("error: the compiled model could not be loaded: {}\nhint: remove '{}' to have "
                                       "it compiled again",
                                       run.not_loaded, path));
    if (!run.complaint.empty()) throw InternalError("a compiled model was told: " + run.complaint);
    read_report(run.report, outcome);
    return !run.interrupted;
}

} // namespace lagen
