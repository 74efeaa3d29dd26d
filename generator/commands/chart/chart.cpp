// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/chart.hpp"

#include "commands/chart/measure.hpp"
#include "commands/line/options.hpp"
#include "commands/machine/write_file.hpp"
#include "elaborate/bind_parameters.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>

namespace lagen {

namespace {

/// What the processor calls itself.
std::string machine_name()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
    return "an unnamed processor";
}

} // namespace

CheckedModel charted_model(const Options& options, const std::string& path)
{
    CheckedModel checked = read(path, options.settings(), options.has("unchecked"));
    bind_all_in_scene(checked.model, find_scene(checked.model, options.get("scene")));
    prove(checked);
    return checked;
}

Chart make_chart(CheckedModel& checked, const ChartRequest& request)
{
    ChartProblem problem = chart_problem(checked, request.scene, request.form);
    Chart chart;
    chart.model = checked.model.name;
    chart.title = checked.model.title;
    chart.scene = request.scene.name;
    chart.form = request.form;
    chart.energy_changes = has_kernel(problem.module, "power");
    std::vector<MethodFamily> families = method_families(problem, request.methods, chart.left_out);
    if (request.peers)
        for (MethodFamily& peer : peer_families(problem, chart.left_out)) families.push_back(std::move(peer));
    require_quad();
    std::vector<ProgramText> texts = reference_programs(problem);
    for (const MethodFamily& family : families) texts.push_back(family.text);
    const std::vector<std::string> programs = compile_programs(texts);
    for (std::size_t k = 0; k < families.size(); ++k) families[k].program = programs[k + 2];
    const std::array<std::string, 2> methods = reference_methods(problem);
    chart.reference_methods = {methods.begin(), methods.end()};
    write_standard_error(fmt::format("reference in 113 bits: {} and {}\n", methods[0], methods[1]));
    const ChartReference reference = make_reference(problem, {programs[0], programs[1]}, chart.scene);
    chart.start = problem.start;
    chart.end = problem.end;
    chart.times = problem.times;
    chart.reference_error = reference.error;
    chart.shortened = reference.shortened;
    chart.ended_by_event = reference.ended_by_event;
    chart.machine = machine_name();
    chart.compiler = compiler_text();
    chart.points = measure_points(problem, reference, families, chart.repeats);
    return chart;
}

const ChartPoint* cheapest_within(const std::vector<ChartPoint>& points, double error)
{
    const ChartPoint* best = nullptr;
    for (const ChartPoint& point : points)
        if (point.error && *point.error <= error && (best == nullptr || point.seconds < best->seconds)) best = &point;
    return best;
}

} // namespace lagen
