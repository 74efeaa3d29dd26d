// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/stability_chart.hpp"

#include "commands/chart/contestants.hpp"
#include "commands/chart/problem.hpp"
#include "commands/chart/stability_discrete.hpp"
#include "commands/scene/linear_limits.hpp"
#include "commands/scene/scene_options.hpp"
#include "commands/scene/start_state.hpp"
#include "emit/print_header.hpp"
#include "lagen_run/archive.hpp"
#include "linear/linear_system.hpp"
#include "model/scene_form.hpp"
#include "scene/sample_times.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <thread>
#include <tuple>

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
    if (axes.size() > 1)
        if (const auto name = initial_name(axes[1].name))
            set_initial(model, stepped, {*name, whole_text("<--over>", "0")});
    return stepped;
}

/// Sets the quantity of the request that a run of the equations keeps, and returns its name.
std::string follow(const KernelModule& module, chart::StabilityRequest& request)
{
    if (!has_kernel(module, "power"))
        for (const char* kept : {"energy", "hamiltonian"})
            if (has_kernel(module, kept)) {
                request.follow = chart::Follow::energy;
                return kept;
            }
    if (!has_kernel(module, "invariants")) return "";
    const std::vector<std::string>& names = kernel_named(module, "invariants").outputs[0].entry_names;
    if (names.empty()) return "";
    request.follow = chart::Follow::invariant;
    return "invariant " + names[0];
}

/// Methods of one program.
using MethodGroup = std::vector<const MethodEntry*>;

std::vector<MethodGroup> groups_of(const ChartProblem& problem, const std::vector<const MethodEntry*>& wanted,
                                   std::vector<LeftOutMethod>& left_out)
{
    std::map<MethodKind, MethodGroup> groups;
    for (const MethodEntry& method : method_table()) {
        if (!wanted.empty() && std::ranges::find(wanted, &method) == wanted.end()) continue;
        if (*method.scheme != '\0') continue; // has equations of its own
        const std::string obstacle =
            method.adaptive ? fmt::format("{} takes a tolerance, and a stability chart is over steps", method.name)
            : method.composes
                ? fmt::format("{} composes steps, and a stability chart takes them one by one", method.name)
                : obstacle_to(method, problem);
        if (obstacle.empty())
            groups[method.kind].push_back(&method);
        else if (!wanted.empty())
            throw UsageError(obstacle);
        else
            left_out.push_back({method.name, obstacle});
    }
    std::vector<MethodGroup> list;
    for (auto& [kind, methods] : groups) list.push_back(std::move(methods));
    if (list.empty()) list.emplace_back(); // the figures of the columns are found all the same
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
                                 class_name(problem.module.name), types, names)};
    text.options = rounding_options();
    return text;
}

/// The start of every column.
std::vector<chart::ColumnStart> column_starts(CheckedModel& checked, const Scene& scene, const StabilityChart& chart,
                                              ChartProblem& problem)
{
    StartState start([&](bool) -> const CheckedModel& { return checked; }, chart.form);
    SceneEvaluator evaluate(checked.model, scene);
    std::vector<chart::ColumnStart> starts;
    for (const ColumnPlace& place : column_places(chart.axes)) {
        const SceneValues values = evaluate(place.parameters, place.initial);
        problem.parameters = doubles_of(finite_numbers(values.parameters, scene));
        problem.initial = doubles_of(finite_start(start, values, scene));
        const SampleTimes times = sample_times(scene, values, problem.initial.size() + 1, true);
        problem.start = static_cast<double>(times.start);
        problem.end = static_cast<double>(times.end);
        starts.push_back({problem.parameters, problem.initial});
    }
    return starts;
}

/// The largest imaginary part of an eigenvalue; of the equations of steps the largest |arg lambda|/h.
double fastest_oscillation(const chart::LinearParts& parts)
{
    const auto lanes = static_cast<Eigen::Index>(parts.lanes);
    double fastest = 0;
    for (std::size_t k = 0; k < parts.entries.size(); k += parts.lanes * parts.lanes) {
        const linear::Matrix part = Eigen::Map<const linear::Matrix>(&parts.entries[k], lanes, lanes);
        for (const linear::Eigenvalue& value : linear::eigenvalues(part))
            fastest = std::max(fastest, parts.step > 0 ? std::abs(std::arg(value)) / parts.step : value.imag());
    }
    return fastest;
}

/// Adds what a program answered to what the others did.
void take_answer(std::string_view answer, StabilityChart& chart)
{
    chart::StabilityAnswer found;
    if (!detail::take_packed(answer, found) || !answer.empty())
        throw InternalError("a program of a chart gave another answer");
    if (chart.columns.empty()) { // every program finds the same
        chart.columns = std::move(found.columns);
        for (std::size_t j = 0; j < found.linear.size(); ++j)
            chart.columns.at(j).omega = fastest_oscillation(found.linear[j]);
    }
    for (chart::MethodFates& method : found.methods) chart.methods.push_back({std::move(method)});
}

/// Of x'' = -omega^2 x; the flows of a sum of flows are others.
double limit_of(const MethodEntry& entry, const std::string& scheme, bool has_flows)
{
    if (entry.kind == MethodKind::splitting && has_flows) return no_limit;
    const LinearLimits* limits = find_limits(entry.kind == MethodKind::discrete ? scheme : entry.type);
    return limits != nullptr ? limits->imaginary : no_limit;
}

/// Those of the linear interval, and the folds where they are met before.
void add_limits(ChartedMethod& method, const std::vector<ColumnFigures>& columns, double end)
{
    for (std::size_t j = 0; j < columns.size(); ++j) {
        std::optional<double>& limit = method.limits.emplace_back();
        if (end != no_limit && columns[j].omega > 0) limit = end / columns[j].omega;
        if (j < method.folds.size() && method.folds[j] > 0) limit = std::min(limit.value_or(no_limit), method.folds[j]);
    }
}

void require_length(const StabilityChart& chart, const Scene& scene)
{
    if (chart.start == chart.end)
        throw ModelError(fmt::format("scene '{}' has no length: there is nothing to chart", scene.name), scene.where);
}

std::size_t processors()
{
    return std::max(1U, std::thread::hardware_concurrency());
}

/// The scene in a form of rates: programs by groups of methods, and what each of them is asked.
class CurvePart {
  public:
    CurvePart(CheckedModel& checked, const Scene& scene, StabilityChart& chart)
    {
        request_.starts = column_starts(checked, scene, chart, problem_);
        request_.steps = chart.axes[0].values;
        chart.start = request_.start = problem_.start;
        chart.end = request_.end = problem_.end;
        GenerateRequest kernels;
        kernels.form = chart.form;
        kernels.scene = &scene;
        kernels.flows = true;
        Generated generated = generate(checked, kernels);
        problem_.header = std::move(generated.header);
        problem_.module = std::move(generated.module);
        chart.followed = follow(problem_.module, request_);
    }

    [[nodiscard]] const ChartProblem& problem() const { return problem_; }
    [[nodiscard]] bool has_flows() const { return problem_.module.flows.count > 0; }

    void run(const std::vector<MethodGroup>& groups, StabilityChart& chart) const
    {
        std::vector<ProgramText> texts;
        for (const MethodGroup& methods : groups) texts.push_back(program_of(problem_, methods));
        std::vector<ChartCall> calls;
        chart::StabilityRequest request = request_;
        for (const std::string& program : compile_programs(texts)) {
            calls.push_back({program, detail::packed(request)});
            request.linear = false; // the first one tells of the columns
        }
        for (const std::string& answer : answers_of(calls, processors())) take_answer(answer, chart);
    }

  private:
    ChartProblem problem_;
    chart::StabilityRequest request_;
};

/// Runs them, with the figures of the columns where they are known.
void run_contestants(const std::vector<DiscreteContestant>& contestants, StabilityChart& chart)
{
    std::vector<ProgramText> texts;
    for (const DiscreteContestant& contestant : contestants) texts.push_back(contestant.text);
    const std::vector<std::string> programs = compile_programs(texts);
    std::vector<ChartCall> calls;
    for (std::size_t k = 0; k < contestants.size(); ++k) {
        chart::StabilityRequest request = contestants[k].request;
        request.figures = chart.columns;
        calls.push_back({programs[k], detail::packed(request)});
    }
    const std::vector<std::string> answers = answers_of(calls, processors());
    for (std::size_t k = 0; k < contestants.size(); ++k) {
        take_answer(answers[k], chart);
        add_limits(chart.methods.back(), chart.columns, limit_of(*contestants[k].method, contestants[k].scheme, false));
    }
}

/// Of the methods that are wanted, or of all of them.
std::vector<DiscreteContestant> variational_contestants(const CheckedModel& checked, const ChartRequest& request,
                                                        const Scene& scene, StabilityChart& chart)
{
    std::vector<DiscreteContestant> list;
    for (const MethodEntry& method : method_table()) {
        if (*method.scheme == '\0') continue;
        const bool wanted = std::ranges::find(request.methods, &method) != request.methods.end();
        if (!wanted && !request.methods.empty()) continue;
        try {
            list.push_back(variational_contestant(checked, method, scene, chart));
        } catch (const MathematicsError& error) {
            if (wanted) throw;
            chart.left_out.push_back({method.name, fmt::format("{} does not apply: {}", method.name, error.message())});
        }
    }
    return list;
}

void chart_curves(CheckedModel& checked, const ChartRequest& request, const Scene& scene, StabilityChart& chart)
{
    const CurvePart part(checked, scene, chart);
    require_length(chart, scene);
    const std::vector<MethodGroup> groups = groups_of(part.problem(), request.methods, chart.left_out);
    const std::vector<DiscreteContestant> variational = variational_contestants(checked, request, scene, chart);
    part.run(groups, chart);
    for (ChartedMethod& method : chart.methods)
        add_limits(method, chart.columns, limit_of(*find_method(method.name), "", part.has_flows()));
    run_contestants(variational, chart);
}

/// The columns by the motion of [lagrangian], where the model has one that starts there.
void look_at_curves(const CheckedModel& checked, const Scene& scene, StabilityChart& chart)
{
    const std::string form = entry_of(FormKind::lagrange).name;
    if (!checked.model.lagrangian) return;
    StabilityChart curves = chart;
    curves.form = form;
    try {
        CheckedModel own = checked;
        Scene continuous = in_form(checked.model, scene, form);
        continuous.duration = number(Rational(chart.end - chart.start));
        CurvePart(own, continuous, curves).run({{}}, curves);
    } catch (const MathematicsError&) {
        return; // its velocities do not follow from the momenta
    }
    if (curves.followed == chart.followed) chart.columns = std::move(curves.columns);
}

void chart_steps(CheckedModel& checked, const ChartRequest& request, const Scene& scene, StabilityChart& chart)
{
    const MethodEntry& method = *find_method("discrete");
    std::tie(chart.start, chart.end) = span_of_steps(checked.model, request.scene);
    require_length(chart, scene);
    const DiscreteContestant contestant = discrete_contestant(checked, method, scene, chart, std::nullopt);
    chart.followed = contestant.followed;
    ChartProblem problem;
    problem.module = contestant.module;
    (void)groups_of(problem, request.methods, chart.left_out);
    for (const MethodEntry& other : method_table()) {
        if (*other.scheme == '\0') continue;
        const std::string reason = fmt::format("{} makes the steps of [lagrangian], and scene '{}' those of [discrete]",
                                               other.name, scene.name);
        if (std::ranges::find(request.methods, &other) != request.methods.end())
            throw UsageError(reason, "--form lagrange");
        if (request.methods.empty()) chart.left_out.push_back({other.name, reason});
    }
    look_at_curves(checked, scene, chart);
    run_contestants({contestant}, chart);
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
    if (form_named(chart.form).steps)
        chart_steps(checked, request, scene, chart);
    else
        chart_curves(checked, request, scene, chart);
    return chart;
}

} // namespace lagen
