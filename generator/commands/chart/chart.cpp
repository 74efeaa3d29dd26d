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

/// Keeps the methods that are wanted. Throws where one of them does not apply.
void choose_methods(std::vector<MethodFamily>& families, std::vector<LeftOutMethod>& left_out,
                    const std::vector<const MethodEntry*>& wanted)
{
    if (wanted.empty()) return;
    for (const MethodEntry* method : wanted)
        for (const LeftOutMethod& other : left_out)
            if (other.method == method->name) throw UsageError("lagen chart: " + other.reason);
    left_out.clear();
    for (MethodFamily& family : families)
        std::erase_if(family.methods, [&](const Contestant& method) {
            return std::ranges::find(wanted, find_method(method.name)) == wanted.end();
        });
}

/// What a probe of the right-hand side refused applies no more than what was left out before.
void leave_out_refused(Chart& chart, bool wanted)
{
    std::erase_if(chart.points, [&](const ChartPoint& point) {
        if (point.status != "not_separable") return false;
        const std::string reason =
            fmt::format("{} splits a system x' = f(y), y' = g(x), and in model '{}' x' depends on x, or y' on y",
                        point.method, chart.model);
        if (wanted) throw UsageError("lagen chart: " + reason);
        chart.left_out.push_back({point.method, reason});
        return true;
    });
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
    std::vector<MethodFamily> families = method_families(problem, chart.left_out);
    choose_methods(families, chart.left_out, request.methods);
    std::erase_if(families, [](const MethodFamily& family) { return family.methods.empty(); });
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
    leave_out_refused(chart, !request.methods.empty());
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
