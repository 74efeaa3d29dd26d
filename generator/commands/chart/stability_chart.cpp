// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/stability_chart.hpp"

#include "commands/chart/contestants.hpp"
#include "commands/chart/problem.hpp"
#include "commands/scene/start_state.hpp"
#include "emit/print_header.hpp"
#include "scene/sample_times.hpp"
#include "stability/linear_limits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <thread>

namespace lagen {

namespace {

/// The scene without what other charts and runs ask of it.
Scene stepped_scene(const Scene& scene, const std::vector<StabilityAxis>& axes, const Model& model)
{
    Scene stepped = scene;
    stepped.method.clear();
    stepped.step = stepped.time_scale = stepped.tolerance = stepped.relative = stepped.absolute = nullptr;
    stepped.observe.reset();
    stepped.states.reset();
    stepped.events.clear();
    stepped.sampling = {Sampling::Kind::count, nullptr, 2, {}};
    if (axes.size() > 1 && axes[1].name.starts_with("initial."))
        set_initial(model, stepped, {axes[1].name.substr(8), whole_text("<--over>", "0")});
    return stepped;
}

/// What a run of the equations keeps: the line of the request, and its name.
std::pair<std::string, std::string> followed_of(const KernelModule& module)
{
    if (!has_kernel(module, "power")) {
        if (has_kernel(module, "energy")) return {"energy 0", "energy"};
        if (has_kernel(module, "hamiltonian")) return {"energy 0", "hamiltonian"};
    }
    if (has_kernel(module, "invariants")) {
        const std::vector<std::string>& names = kernel_named(module, "invariants").outputs[0].entry_names;
        if (!names.empty()) return {"invariant 0", "invariant " + names[0]};
    }
    return {"size 0", ""};
}

/// Methods of one program.
using MethodGroup = std::vector<const MethodEntry*>;

std::vector<MethodGroup> groups_of(const ChartProblem& problem, const std::vector<const MethodEntry*>& wanted,
                                   std::vector<LeftOutMethod>& left_out)
{
    std::map<MethodKind, MethodGroup> groups;
    for (const MethodEntry& method : method_table()) {
        if (!wanted.empty() && std::ranges::find(wanted, &method) == wanted.end()) continue;
        const std::string obstacle =
            method.adaptive ? fmt::format("{} takes a tolerance, and a stability chart is over steps", method.name)
                            : obstacle_to(method, problem);
        if (obstacle.empty())
            groups[method.kind].push_back(&method);
        else if (!wanted.empty())
            throw UsageError("lagen chart: " + obstacle);
        else
            left_out.push_back({method.name, obstacle});
    }
    std::vector<MethodGroup> list;
    for (auto& [kind, methods] : groups) list.push_back(std::move(methods));
    return list;
}

ProgramText program_of(const ChartProblem& problem, const MethodGroup& methods)
{
    std::string types, names;
    for (const MethodEntry* method : methods) {
        types += fmt::format(", lagen::{}", method->type);
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", method->name);
    }
    ProgramText text{problem.header,
                     fmt::format("#include \"model.hpp\"\n#include \"lagen_chart/stability.hpp\"\nint main(int argc, "
                                 "char** argv)\n{{\n    return lagen::chart_stability<lagen::models::{}<double>{}>"
                                 "({{{}}}, argc, argv);\n}}\n",
                                 cpp_names({problem.module.name})[0], types, names)};
    text.options = rounding_options();
    return text;
}

/// The start of every column, a line each.
std::string column_lines(CheckedModel& checked, const Scene& scene, const StabilityChart& chart, ChartProblem& problem)
{
    StartState start([&](bool) -> const CheckedModel& { return checked; }, chart.form);
    SceneEvaluator evaluate(checked.model, scene);
    std::string text;
    const std::vector<double> alone{0};
    for (const double value : chart.axes.size() > 1 ? chart.axes[1].values : alone) {
        Values parameters, initial;
        if (chart.axes.size() > 1) {
            const std::string& name = chart.axes[1].name;
            const bool starts = name.starts_with("initial.");
            (starts ? initial : parameters)[starts ? name.substr(8) : name] = static_cast<long double>(value);
        }
        const SceneValues values = evaluate(parameters, initial);
        const std::vector<long double> numbers = finite_numbers(values.parameters, scene);
        for (const std::vector<NamedNumber>* group : {&values.base, &values.fibre, &values.momenta})
            (void)finite_numbers(*group, scene);
        const std::vector<long double> lanes = start(values);
        problem.parameters.assign(numbers.begin(), numbers.end());
        problem.initial.assign(lanes.begin(), lanes.end());
        const SampleTimes times = sample_times(scene, values, lanes.size() + 1, true);
        problem.start = static_cast<double>(times.start);
        problem.end = static_cast<double>(times.end);
        text += fmt::format("column{} |{}\n", blank_list(problem.parameters), blank_list(problem.initial));
    }
    return text;
}

/// Reads what a program printed behind what the others did.
void take_answer(const std::string& answer, StabilityChart& chart)
{
    std::istringstream lines(answer);
    std::vector<ColumnFigures> columns;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word, second, third, fourth;
        words >> word >> second >> third >> fourth;
        const auto number = [](const std::string& text) { return std::strtod(text.c_str(), nullptr); };
        if (word == "column")
            columns.push_back({number(second), number(third), number(fourth)});
        else if (word == "method")
            chart.methods.push_back({second, {}, {}});
        else
            chart.methods.back().cells.push_back({word, number(second), number(third), number(fourth)});
    }
    chart.columns = std::move(columns);
}

/// Of x'' = -omega^2 x; the flows of a sum of flows are others.
void add_limits(StabilityChart& chart, const ChartProblem& problem)
{
    for (ChartedMethod& method : chart.methods) {
        const MethodEntry& entry = *find_method(method.name);
        const bool composes = entry.kind == MethodKind::splitting && problem.module.flows.count > 0;
        const double end = composes ? no_limit : oscillation_limit(entry.type);
        for (const ColumnFigures& column : chart.columns)
            method.limits.push_back(end != no_limit && column.omega > 0 ? std::optional(end / column.omega)
                                                                        : std::nullopt);
    }
}

} // namespace

StabilityChart make_stability_chart(CheckedModel& checked, const ChartRequest& request, std::vector<StabilityAxis> axes)
{
    StabilityChart chart;
    chart.model = checked.model.name;
    chart.title = checked.model.title;
    chart.scene = request.scene.name;
    chart.form = request.form;
    chart.axes = std::move(axes);
    const Scene scene = stepped_scene(request.scene, chart.axes, checked.model);
    const SceneValues given = evaluate_scene(checked.model, request.scene);
    set_parameters(checked, finite_numbers(given.parameters, request.scene));
    ChartProblem problem;
    const std::string columns = column_lines(checked, scene, chart, problem);
    chart.start = problem.start;
    chart.end = problem.end;
    if (chart.start == chart.end)
        throw ModelError(fmt::format("scene '{}' has no length: there is nothing to chart", scene.name), scene.where);
    GenerateRequest kernels;
    kernels.form = chart.form;
    kernels.scene = &scene;
    kernels.flows = true;
    Generated generated = generate(checked, kernels);
    problem.header = std::move(generated.header);
    problem.module = std::move(generated.module);
    const auto [follow, name] = followed_of(problem.module);
    chart.followed = name;

    std::vector<ProgramText> texts;
    for (const MethodGroup& methods : groups_of(problem, request.methods, chart.left_out))
        texts.push_back(program_of(problem, methods));
    const std::string whole = fmt::format("span {:.17g} {:.17g}\nfollow {}\nsteps{}\n{}", chart.start, chart.end,
                                          follow, blank_list(chart.axes[0].values), columns);
    std::vector<ChartCall> calls;
    for (const std::string& program : compile_programs(texts)) calls.push_back({program, whole});
    for (const std::string& answer : answers_of(calls, std::max(1U, std::thread::hardware_concurrency())))
        take_answer(answer, chart);
    add_limits(chart, problem);
    return chart;
}

} // namespace lagen
