// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/stability_chart.hpp"

#include "commands/chart/chart.hpp"
#include "commands/chart/reference.hpp"
#include "commands/line/options.hpp"
#include "commands/line/scene_options.hpp"
#include "elaborate/variational_model.hpp"
#include "emit/print_header.hpp"
#include "lagen_run/archive.hpp"
#include "linear/linear_system.hpp"
#include "machine/compile.hpp"
#include "mechanics/discrete.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"
#include "model/scene_form.hpp"
#include "scene/linear_limits.hpp"
#include "scene/methods.hpp"
#include "scene/sample_times.hpp"
#include "scene/scene_program.hpp"
#include "scene/start_state.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <thread>
#include <tuple>

namespace lagen {

namespace {

// Discrete motions in a stability chart: the one of [discrete], and those that variational methods make of
// [lagrangian]. Each has equations of its own, and so a program (runtime/program/lagen_chart/discrete_stability.hpp).

struct DiscreteContestant {
    const MethodEntry* method = nullptr;
    std::string scheme; ///< that made the discrete Lagrangian; empty: it is written out
    KernelModule module;
    ProgramText text;
    chart::StabilityRequest request; ///< without the figures of the columns
    std::string followed;            ///< as in StabilityChart
};

/// Sets the quantity of the request that is followed, and returns its name.
std::string follow_in_steps(const CheckedModel& checked, const KernelModule& module,
                            const std::optional<std::string>& wanted, chart::StabilityRequest& request)
{
    const bool energy = has_kernel(module, "energy") && keeps_energy(checked.system);
    if (energy && (!wanted || *wanted == "energy" || *wanted == "hamiltonian")) {
        request.follow = chart::Follow::energy;
        return "energy";
    }
    if (wanted && wanted->empty()) return "";
    if (has_kernel(module, "invariants")) {
        const std::vector<std::string>& names = kernel_named(module, "invariants").outputs[0].entry_names;
        for (std::size_t k = 0; k < names.size(); ++k)
            if (!wanted || *wanted == "invariant " + names[k]) {
                request.follow = chart::Follow::invariant;
                request.invariant = k;
                return "invariant " + names[k];
            }
    }
    if (wanted)
        throw MathematicsError(
            fmt::format("the discrete form of model '{}' has no {} to follow", module.model, *wanted));
    return "";
}

/// The number of the parameter that is the step; behind those of the model where it is none of them.
std::size_t step_number(const Model& model)
{
    const std::vector<Symbol> symbols = free_parameters(model);
    const auto place = std::ranges::find(symbols, model.discrete->step.name, &Symbol::name);
    return static_cast<std::size_t>(place - symbols.begin());
}

/// A start for every step of every column.
class CellStarts {
  public:
    CellStarts(CheckedModel& checked, const Scene& scene, const StabilityChart& chart)
        : model_(checked.model), scene_(scene), chart_(chart), start_(checked, scene.form), evaluate_(model_, scene)
    {
    }

    [[nodiscard]] std::vector<chart::ColumnStart> all()
    {
        std::vector<chart::ColumnStart> starts;
        for (const ColumnPlace& place : column_places(chart_.axes))
            for (const double step : chart_.axes[0].values) starts.push_back(start_of(step, place));
        return starts;
    }

  private:
    [[nodiscard]] chart::ColumnStart start_of(double step, const ColumnPlace& column)
    {
        Values parameters = column.parameters;
        const std::string& step_name = model_.discrete->step.name;
        const std::size_t place = step_number(model_);
        const bool own = place == free_parameters(model_).size();
        if (!own) parameters[step_name] = static_cast<long double>(step);
        const SceneValues values = evaluate_(parameters, column.initial);
        std::vector<double> numbers = doubles_of(finite_numbers(values.parameters, scene_));
        if (own) numbers.push_back(step);
        return {std::move(numbers), doubles_of(finite_start(start_, values, scene_))};
    }

    const Model& model_;
    const Scene& scene_;
    const StabilityChart& chart_;
    StartState start_;
    SceneEvaluator evaluate_;
};

ProgramText stepping_program(const Generated& generated, const char* name)
{
    ProgramText text{generated.header,
                     main_text({"model.hpp", "lagen_chart/discrete_stability.hpp"},
                               fmt::format("chart_discrete_stability<lagen::models::{}<double>>(\"{}\", argc, argv)",
                                           class_name(generated.module.name), name))};
    text.options = rounding_options();
    return text;
}

/// The scene in its discrete form by `method`, for every step and column of `chart`, which has its axes, start and end.
/// `checked` has [discrete] and is proved. `followed`: what the other methods follow; nothing where there are none.
/// Throws MathematicsError where the scene goes backwards, or the discrete form has nothing of that name to follow.
DiscreteContestant discrete_contestant(CheckedModel& checked, const MethodEntry& method, const Scene& scene,
                                       const StabilityChart& chart, const std::optional<std::string>& followed)
{
    const std::string form = entry_of(FormKind::discrete).name;
    const Scene own = in_form(checked.model, scene, form);
    if (chart.end < chart.start)
        throw MathematicsError(
            fmt::format("{} makes steps forwards alone, and the scene '{}' goes backwards", method.name, scene.name));
    GenerateRequest kernels;
    kernels.form = form;
    kernels.scene = &own;
    Generated generated = generate(checked, kernels);
    DiscreteContestant contestant;
    contestant.method = &method;
    contestant.scheme = checked.model.discrete->scheme;
    contestant.request.start = chart.start;
    contestant.request.end = chart.end;
    contestant.request.steps = chart.axes[0].values;
    contestant.request.step = step_number(checked.model);
    contestant.request.starts = CellStarts(checked, own, chart).all();
    contestant.followed = follow_in_steps(checked, generated.module, followed, contestant.request);
    contestant.text = stepping_program(generated, method.name);
    contestant.module = std::move(generated.module);
    return contestant;
}

/// The same of `checked`, in continuous time, by a variational method; `checked` stays as it is.
DiscreteContestant variational_contestant(const CheckedModel& checked, const MethodEntry& method, const Scene& scene,
                                          const StabilityChart& chart)
{
    CheckedModel own = checked;
    own.model = variational_model(std::move(own.model), method.scheme, method.name);
    prove(own);
    Scene steps = scene;
    steps.form.clear();
    const SceneValues given = evaluate_scene(checked.model, scene);
    set_parameters(own, finite_numbers(given.parameters, scene));
    return discrete_contestant(own, method, steps, chart, chart.followed);
}

/// Where the scene begins, and ends by its duration, else by its steps. Throws ModelError where it starts from an
/// arrow, which belongs to its step.
std::pair<double, double> span_of_steps(const Model& model, const Scene& scene)
{
    const SceneValues values = evaluate_scene(model, scene);
    if (starts_from_arrow(values))
        throw ModelError(
            fmt::format("scene '{}' starts from an arrow, which belongs to its step, and a stability chart "
                        "is over steps",
                        scene.name),
            scene.where, "give 'initial' the momenta of the start");
    if (values.duration)
        return {static_cast<double>(values.start), static_cast<double>(values.start + *values.duration)};
    const SampleTimes times = sample_times(scene, values, 1, true);
    return {static_cast<double>(times.start), static_cast<double>(times.end)};
}

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
    ProgramText text{problem.header, main_text({"model.hpp", "lagen_chart/stability.hpp"},
                                               call_of("chart_stability", problem.module, methods))};
    text.options = rounding_options();
    return text;
}

/// The start of every column.
std::vector<chart::ColumnStart> column_starts(CheckedModel& checked, const Scene& scene, const StabilityChart& chart,
                                              ChartProblem& problem)
{
    StartState start(checked, chart.form);
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

constexpr std::uint64_t most_cells = 1'000'000;
constexpr const char* initial_prefix = "initial.";

} // namespace

StabilityChart make_stability_chart(CheckedModel& checked, const ChartRequest& request, std::vector<StabilityAxis> axes)
{
    StabilityChart chart;
    chart.model = checked.model.name;
    chart.title = checked.model.title;
    chart.scene = request.scene.name;
    chart.form = request.scene.form;
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

std::vector<StabilityAxis> stability_axes(const std::string& over, const Model& model, const Scene& scene)
{
    const std::vector<std::string> texts = split_list(over);
    if (texts.empty() || texts.size() > 2 || !texts[0].starts_with("step="))
        throw UsageError("--stability needs --over step=FIRST:LAST:COUNT, and behind a comma at most one range more, "
                         "of a parameter or of initial.NAME");
    std::vector<StabilityAxis> axes;
    std::vector<RangeText> ranges;
    for (const std::string& text : texts) {
        const Setting setting = read_setting("over", text);
        const RangeText& range = ranges.emplace_back(range_of("over", setting.value, text));
        if (range.parts.size() != 3) range.refuse("a range is FIRST:LAST:COUNT");
        const GridAxis grid = axis_of(range, model, most_cells);
        StabilityAxis& axis = axes.emplace_back(StabilityAxis{setting.name, {}});
        for (std::uint64_t k = 0; k < grid.count; ++k) axis.values.push_back(grid.at(k));
    }
    for (const double step : axes[0].values)
        if (!(step > 0)) ranges[0].refuse(fmt::format("a step of {} is not positive", step));
    if (axes.size() == 1) return axes;
    StabilityAxis& second = axes[1];
    if (second.values.size() * axes[0].values.size() > most_cells)
        throw UsageError(fmt::format("--over {}: the chart has more than {} points", over, most_cells));
    const std::optional<std::string> starts = initial_name(second.name);
    const std::string prefix = starts ? initial_prefix : "";
    const SourceRange where = whole_text("<--over>", texts[1]).range(0, second.name.size());
    const SweptName name =
        resolved({starts ? "initial" : "set", starts.value_or(second.name)}, model, scene, "to chart over", where);
    second.name = prefix + name.name;
    second.heading = prefix + plain_names({name.name}, all_names(model))[0];
    return axes;
}

std::optional<std::string> initial_name(const std::string& name)
{
    const std::string_view prefix = initial_prefix;
    return name.starts_with(prefix) ? std::optional(name.substr(prefix.size())) : std::nullopt;
}

std::vector<ColumnPlace> column_places(const std::vector<StabilityAxis>& axes)
{
    if (axes.size() < 2) return {{}};
    const std::optional<std::string> starts = initial_name(axes[1].name);
    std::vector<ColumnPlace> places;
    for (const double value : axes[1].values) {
        ColumnPlace& place = places.emplace_back();
        (starts ? place.initial : place.parameters)[starts.value_or(axes[1].name)] = static_cast<long double>(value);
    }
    return places;
}

} // namespace lagen
