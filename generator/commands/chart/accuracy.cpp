// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/accuracy.hpp"

#include "commands/chart/report.hpp"
#include "commands/line/scene_options.hpp"
#include "machine/compile_cache.hpp"
#include "machine/write_file.hpp"
#include "model/scene_form.hpp"
#include "scene/integrate_scene.hpp"
#include "scene/preparation.hpp"
#include "scene/run_record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace lagen {

namespace {

constexpr int most_confirmations = 5, most_same = 10;

/// A smaller tolerance or step, as the next one of a chart's ladder.
double tightened(const MethodEntry& method, double parameter)
{
    return parameter * (method.adaptive ? 0.31622776601683794 : 0.5);
}

double accuracy_option(const Options& options)
{
    for (const char* other : {"method", "step", "time-scale", "tolerance"})
        if (options.has(other))
            throw UsageError(fmt::format("--accuracy chooses method, tolerance and step: leave out --{}", other));
    const std::string text = options.get("accuracy");
    char* end = nullptr;
    const double accuracy = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(accuracy > 0) || !(accuracy < 1))
        throw UsageError(fmt::format("--accuracy needs a number between 0 and 1, found '{}'", text));
    return accuracy;
}

/// The tolerance, or the step.
void use_parameter(double parameter, const MethodEntry& method, ProgramInput& input)
{
    (method.adaptive ? input.relative : input.step) = parameter;
    if (method.adaptive) input.absolute = parameter;
}

/// The whole state in every row.
Table states_with(double parameter, const MethodEntry& method, const RunRecord& record, ProgramInput input)
{
    use_parameter(parameter, method, input);
    input.columns.clear();
    RunOutcome outcome;
    outcome.table.columns = {"t"};
    for (std::size_t k = 0; k < record.names.lanes.size(); ++k) {
        input.columns.push_back({record.names.lanes[k], true, k});
        outcome.table.columns.push_back(record.names.lanes[k]);
    }
    integrate_scene(record.program, input, outcome);
    return succeeded(outcome.status) ? outcome.table : Table{};
}

/// The program for this accuracy, and those that other ones will ask for, at once.
void compile_best(const CheckedModel& checked, const Scene& scene, const KeptChart& chart, double accuracy)
{
    std::vector<double> errors{accuracy};
    errors.insert(errors.end(), std::begin(charted_errors), std::end(charted_errors));
    std::vector<std::string> methods;
    std::vector<ProgramText> programs;
    for (const double error : errors) {
        const ChartPoint* best = cheapest_within(chart.points, error);
        if (best == nullptr || std::ranges::find(methods, best->method) != methods.end()) continue;
        methods.push_back(best->method);
        programs.push_back(scene_text(checked, scene, *find_method(best->method), run_driver).text);
    }
    if (chart.obstacle.empty()) compile_programs(programs);
}

constexpr std::string_view chart_heading = "what `lagen chart` of " LAGEN_VERSION " measured, packed\n";

} // namespace

std::optional<AccurateMethod> accurate_method(const Options& options, const CheckedModel& checked,
                                              const std::string& path)
{
    if (!options.has("accuracy")) return std::nullopt;
    const double accuracy = accuracy_option(options);
    const std::string file = chart_file(options, checked.model);
    std::optional<KeptChart> kept = find_chart(file);
    if (!kept) {
        write_standard_error("no chart of this scene is kept: it is made now\n");
        CheckedModel own = charted_model(options, path);
        const Scene scene = scene_of(options, own.model, options.named("initial"));
        kept = kept_chart(make_chart(own, {scene}));
        keep_chart(file, *kept);
        compile_best(own, scene, *kept, accuracy);
    }
    return choose_method(*kept, accuracy);
}

AccurateMethod choose_method(const KeptChart& chart, double accuracy)
{
    if (!chart.obstacle.empty())
        throw MathematicsError(fmt::format("no accuracy can be promised to the end of the run: {}", chart.obstacle),
                               "--t-end makes the run shorter");
    const ChartPoint* best = cheapest_within(chart.points, accuracy);
    if (best != nullptr) return {find_method(best->method), best->parameter, accuracy, *best->error};
    const ChartPoint* nearest = nullptr;
    for (const ChartPoint& point : chart.points)
        if (point.error && (nearest == nullptr || *point.error < *nearest->error)) nearest = &point;
    const std::string least = nearest == nullptr
                                  ? "none succeeds"
                                  : fmt::format("the least error is {:.2g}, by {} with {}", *nearest->error,
                                                nearest->method, parameter_text(*nearest));
    throw MathematicsError(fmt::format("no method comes within {:g} of the reference: {}", accuracy, least));
}

bool confirm_accuracy(const AccurateMethod& accurate, const RunRecord& record, ProgramInput& input)
{
    const MethodEntry& method = *accurate.method;
    const char* what = method.adaptive ? "tolerance" : "step";
    double parameter = accurate.parameter, distance = 0;
    Table rows = states_with(parameter, method, record, input);
    if (rows.count() == 0) { // the run itself will say why
        use_parameter(parameter, method, input);
        warn(fmt::format("accuracy {:g} is not confirmed: {} with {} {:.3g} does not come to the "
                         "end",
                         accurate.accuracy, method.name, what, parameter));
        return false;
    }
    for (int k = 0; k < most_confirmations; ++k) {
        double finer = tightened(method, parameter);
        Table finer_rows = states_with(finer, method, record, input);
        // The same steps confirm nothing.
        for (int same = 0; same < most_same && finer_rows.numbers == rows.numbers; ++same) {
            finer = tightened(method, finer);
            finer_rows = states_with(finer, method, record, input);
        }
        distance = table_distance(rows, finer_rows);
        use_parameter(parameter, method, input);
        // With the next one half as wrong, the error of this one is at most twice their distance.
        if (2 * distance <= accurate.accuracy) {
            write_standard_error(fmt::format("accuracy {:g}: {} with {} {:.3g}; {} {:.3g} moves no row by more than "
                                             "{:.2g}\n",
                                             accurate.accuracy, method.name, what, parameter, what, finer, distance));
            return true;
        }
        parameter = finer;
        rows = std::move(finer_rows);
    }
    warn(fmt::format("accuracy {:g} is not confirmed: {} with {} {:.3g} and with the next one "
                     "differ by {:.2g}",
                     accurate.accuracy, method.name, what,
                     static_cast<double>(method.adaptive ? *input.relative : *input.step), distance));
    return false;
}

double table_distance(const Table& a, const Table& b)
{
    if (a.count() == 0 || a.count() != b.count()) return HUGE_VAL;
    double most = 0;
    for (std::size_t k = 0; k < a.count(); ++k) {
        const double distance = row_distance(a.row(k), b.row(k)), size = row_size(b.row(k));
        most = std::max(most, size > 0 ? distance / size : distance);
    }
    return most;
}

std::string chart_file(const Options& options, const Model& model)
{
    ContentHash hash;
    for (const char* option : {"scene", "form", "t-end", "at", "unchecked"})
        hash.add(options.has(option) ? option : "").add(options.get(option));
    for (const Setting& setting : options.settings())
        hash.add(setting.binds ? "bind" : "set").add(setting.name).add(setting.value.text);
    for (const Setting& setting : options.named("initial"))
        hash.add("initial").add(setting.name).add(setting.value.text);
    Model charted = model; // the same whether parameters are bound yet or not
    for (Parameter& parameter : charted.parameters) parameter.bound = false;
    add_model(hash, charted);
    return kept_file(hash.add("chart"));
}

KeptChart kept_chart(const Chart& chart)
{
    return {chart.points, chart.ended_by_event ? "" : chart.shortened};
}

std::optional<KeptChart> find_chart(const std::string& file)
{
    return kept<KeptChart>(file, chart_heading);
}

void keep_chart(const std::string& file, const KeptChart& chart)
{
    keep(file, chart_heading, chart);
}

} // namespace lagen
