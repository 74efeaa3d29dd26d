// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/stability_discrete.hpp"

#include "commands/scene/scene_program.hpp"
#include "commands/scene/start_state.hpp"
#include "elaborate/variational_model.hpp"
#include "emit/print_header.hpp"
#include "graph/core/graph.hpp"
#include "mechanics/discrete.hpp"
#include "model/families.hpp"
#include "model/scene_form.hpp"
#include "scene/sample_times.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

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
        : model_(checked.model), scene_(scene), chart_(chart),
          start_([&checked](bool) -> const CheckedModel& { return checked; }, scene.form), evaluate_(model_, scene)
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
    ProgramText text{
        generated.header,
        fmt::format("#include \"model.hpp\"\n#include \"lagen_chart/discrete_stability.hpp\"\nint "
                    "main(int argc, char** argv)\n{{\n    return "
                    "lagen::chart_discrete_stability<lagen::models::{}<double>>(\"{}\", argc, argv);\n}}\n",
                    class_name(generated.module.name), name)};
    text.options = rounding_options();
    return text;
}

} // namespace

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

} // namespace lagen
