// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/problem.hpp"

#include "commands/machine/process.hpp"
#include "commands/machine/temporary_folder.hpp"
#include "commands/machine/write_file.hpp"
#include "commands/scene/scene_program.hpp"
#include "commands/scene/start_state.hpp"
#include "scene/sample_times.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

constexpr std::size_t even_samples = 21;

/// Of the scene, its events that do not end it apart, and what it says of methods, rows and columns.
Scene bare_scene(const Scene& scene)
{
    Scene bare = scene;
    bare.method.clear();
    bare.step = bare.time_scale = bare.tolerance = bare.relative = bare.absolute = nullptr;
    bare.observe.reset();
    bare.states.reset();
    std::erase_if(bare.events, [](const Event& event) { return !event.stop; });
    if (bare.sampling.kind != Sampling::Kind::at) bare.sampling = {Sampling::Kind::count, nullptr, even_samples, {}};
    return bare;
}

} // namespace

ChartProblem chart_problem(CheckedModel& checked, const Scene& whole, const std::string& form)
{
    const Scene scene = bare_scene(whole);
    const SceneValues values = evaluate_scene(checked.model, scene);
    const std::vector<long double> parameters = finite_numbers(values.parameters, scene);
    set_parameters(checked, parameters);
    ChartProblem problem;
    problem.parameters = doubles_of(parameters);
    StartState start([&](bool) -> const CheckedModel& { return checked; }, form);
    problem.initial = doubles_of(finite_start(start, values, scene));
    const SampleTimes times = sample_times(scene, values, problem.initial.size() + 1, true);
    problem.start = static_cast<double>(times.start);
    problem.end = static_cast<double>(times.end);
    if (problem.start == problem.end)
        throw ModelError(fmt::format("scene '{}' has no length: there is nothing to chart", scene.name), scene.where);
    if (times.kind == Sampling::Kind::at)
        problem.times = doubles_of(times.at);
    else
        sample_evenly(problem, even_samples);
    problem.events = scene.events;
    GenerateRequest request;
    request.form = form;
    request.scene = &scene;
    request.with = {"taylor"};
    request.flows = true;
    Generated generated;
    try {
        generated = generate(checked, request);
    } catch (const MathematicsError& error) {
        problem.no_series = error.message();
        request.with.clear();
        generated = generate(checked, request);
    }
    problem.header = std::move(generated.header);
    problem.module = std::move(generated.module);
    return problem;
}

void sample_evenly(ChartProblem& problem, std::size_t count)
{
    problem.times.clear();
    for (std::size_t k = 0; k + 1 < count; ++k)
        problem.times.push_back(problem.start + (problem.end - problem.start) * static_cast<double>(k) /
                                                    static_cast<double>(count - 1));
    problem.times.push_back(problem.end);
}

chart::Request request_of(const ChartProblem& problem)
{
    chart::Request request;
    request.parameters = problem.parameters;
    request.initial = problem.initial;
    request.start = problem.start;
    request.end = problem.end;
    request.at = problem.times;
    return request;
}

std::vector<std::string> answers_of(const std::vector<ChartCall>& calls, std::size_t at_once)
{
    const TemporaryFolder folder(shared_temporary_folder(), "lagen-chart");
    std::vector<std::vector<std::string>> commands;
    for (const ChartCall& call : calls) {
        const std::string file = folder.file(fmt::format("request{}", commands.size()));
        write_file(file, call.request);
        commands.push_back({call.program, file});
    }
    std::vector<std::string> answers;
    for (ProcessResult& result : run_processes(commands, at_once)) {
        if (result.interrupted) throw InterruptedError("lagen: interrupted, nothing was written");
        if (!result.started || result.exit_code != 0)
            throw MachineError(
                fmt::format("a program of the chart ended with exit code {}\n{}", result.exit_code, result.error));
        answers.push_back(std::move(result.output));
    }
    return answers;
}

} // namespace lagen
