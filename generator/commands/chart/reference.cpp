// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/reference.hpp"

#include "emit/print_header.hpp"
#include "lagen_run/archive.hpp"
#include "machine/process.hpp"
#include "machine/temporary_folder.hpp"
#include "machine/write_file.hpp"
#include "scene/methods.hpp"
#include "scene/sample_times.hpp"
#include "scene/scene_program.hpp"
#include "scene/start_state.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <cmath>

namespace lagen {

namespace {

/// A chart shows errors down to 1e-15 or so, of which the reference is to spoil nothing that is seen.
constexpr double reference_agreement = 1e-14;
constexpr std::array reference_tolerances{1e-20, 1e-26};
/// Of Taylor's method, which is cheap at any tolerance, beside that of the pair.
constexpr double series_share = 1e-6;
constexpr std::size_t most_reference_steps = 400'000;

using ReferenceRun = chart::ReferenceReport;

ReferenceRun read_reference(std::string_view answer)
{
    ReferenceRun run;
    if (!detail::take_packed(answer, run)) throw InternalError("a reference of a chart gave another answer");
    return run;
}

/// The problem for a reference of this tolerance.
chart::Request reference_request(const ChartProblem& problem, double tolerance)
{
    chart::Request request = request_of(problem);
    request.tolerance = tolerance;
    request.most = most_reference_steps;
    return request;
}

/// |a - b|_2/|a|_2 of the samples number `sample`.
double distance_at(const std::vector<double>& a, const std::vector<double>& b, std::size_t sample, std::size_t lanes)
{
    double distance = 0, size = 0;
    for (std::size_t k = 2 * lanes * sample; k < 2 * lanes * (sample + 1); k += 2) {
        const double away = (a[k] - b[k]) + (a[k + 1] - b[k + 1]);
        distance += away * away;
        size += a[k] * a[k];
    }
    return std::sqrt(size > 0 ? distance / size : distance);
}

/// How many samples from the first on agree; `most` is their largest distance.
std::size_t agreeing(const std::array<ReferenceRun, 2>& runs, std::size_t lanes, double& most)
{
    const std::size_t samples = std::min(runs[0].rows.size(), runs[1].rows.size()) / (2 * lanes);
    most = 0;
    for (std::size_t k = 0; k < samples; ++k) {
        const double distance = distance_at(runs[0].rows, runs[1].rows, k, lanes);
        if (!(distance <= reference_agreement)) return k;
        most = std::max(most, distance);
    }
    return samples;
}

/// Whether an event ends the scene: the problem ends there too.
bool end_at_event(ChartProblem& problem, const std::string& program)
{
    if (problem.events.empty()) return false;
    chart::Request request = reference_request(problem, reference_tolerances[0]);
    request.events = events_asked(problem.events);
    const ReferenceRun run = read_reference(answers_of({{program, detail::packed(request)}}, 1)[0]);
    if (run.status != "stopped_by_event") return false;
    problem.end = run.t;
    sample_evenly(problem, problem.times.size());
    return true;
}

/// What ended the run that came less far, or that they disagree.
std::string why_shortened(const std::array<ReferenceRun, 2>& runs, const std::array<std::string, 2>& methods)
{
    for (const std::size_t k : {0U, 1U})
        if (runs[k].status != "ok")
            return fmt::format("{} in 113 bits ends with {} at t = {:.9g}", methods[k], runs[k].status, runs[k].t);
    return fmt::format("{} and {} in 113 bits differ by more than {:g} from then on", methods[0], methods[1],
                       reference_agreement);
}

std::array<ReferenceRun, 2> run_references(const ChartProblem& problem, const std::array<std::string, 2>& programs,
                                           const std::array<std::string, 2>& methods, double tolerance)
{
    std::vector<ChartCall> calls;
    for (const std::size_t k : {0U, 1U}) {
        const double own = tolerance * (methods[k] == "taylor" ? series_share : 1);
        calls.push_back({programs[k], detail::packed(reference_request(problem, own))});
    }
    const std::vector<std::string> answers = answers_of(calls, 2);
    return {read_reference(answers[0]), read_reference(answers[1])};
}

constexpr std::size_t even_samples = 21;

/// The scene without its events that do not end it, and without its methods, rows and columns.
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

std::array<std::string, 2> reference_methods(const ChartProblem& problem)
{
    const bool velocity_free = problem.module.second_order.kind == SecondOrder::Kind::velocity_free;
    const char* other = velocity_free ? "verner98" : "verner87";
    return {problem.no_series.empty() ? "taylor" : other, velocity_free ? "rkn1210" : "verner98"};
}

std::vector<ProgramText> reference_programs(const ChartProblem& problem)
{
    std::vector<ProgramText> programs;
    for (const std::string& method : reference_methods(problem)) {
        const std::string text =
            main_text({"lagen_chart/quad.hpp", "model.hpp", "lagen_chart/reference.hpp"},
                      fmt::format("chart_reference<lagen::models::{}<lagen::Quad>, lagen::{}>(argc, argv)",
                                  class_name(problem.module.name), find_method(method)->type));
        programs.push_back({problem.header, text, {"-lquadmath"}});
    }
    return programs;
}

ChartReference make_reference(ChartProblem& problem, const std::array<std::string, 2>& programs,
                              const std::string& scene)
{
    const std::array<std::string, 2> methods = reference_methods(problem);
    const std::size_t lanes = problem.initial.size();
    ChartReference reference;
    reference.ended_by_event = end_at_event(problem, programs[1]);
    if (reference.ended_by_event) reference.shortened = "an event ends the scene";
    std::array<ReferenceRun, 2> runs;
    std::size_t samples = 0;
    for (const double tolerance : reference_tolerances) {
        runs = run_references(problem, programs, methods, tolerance);
        samples = agreeing(runs, lanes, reference.error);
        if (samples == problem.times.size() || runs[0].status != "ok" || runs[1].status != "ok") break;
    }
    if (samples < problem.times.size()) {
        reference.ended_by_event = false;
        reference.shortened = why_shortened(runs, methods);
        if (samples < 2)
            throw MathematicsError(fmt::format("no reference can be made for scene '{}' beyond t = {:.9g}: {}", scene,
                                               problem.start, reference.shortened),
                                   "--t-end makes the chart shorter");
        problem.times.resize(samples);
        problem.end = problem.times.back();
    }
    // Taylor's method is the nearer one of the two, as the tolerances are; else the pair of higher order.
    const ReferenceRun& nearer = runs[methods[0] == "taylor" ? 0 : 1];
    reference.rows.assign(nearer.rows.begin(), nearer.rows.begin() + static_cast<std::ptrdiff_t>(2 * lanes * samples));
    reference.steps = runs[1].steps;
    reference.calls = runs[1].calls;
    return reference;
}

ChartProblem chart_problem(CheckedModel& checked, const Scene& whole)
{
    const Scene scene = bare_scene(whole);
    const SceneValues values = evaluate_scene(checked.model, scene);
    const std::vector<long double> parameters = finite_numbers(values.parameters, scene);
    set_parameters(checked, parameters);
    ChartProblem problem;
    problem.parameters = doubles_of(parameters);
    StartState start(checked, scene.form);
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
    request.form = scene.form;
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
