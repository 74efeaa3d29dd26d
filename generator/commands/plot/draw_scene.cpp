// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/draw_scene.hpp"

#include "commands/line/options.hpp"
#include "commands/line/scene_options.hpp"
#include "commands/plot/labels.hpp"
#include "commands/plot/panel.hpp"
#include "commands/report/run.hpp"
#include "machine/gnuplot.hpp"
#include "machine/process.hpp"
#include "machine/write_file.hpp"
#include "model/read_curve.hpp"
#include "model/scene_form.hpp"
#include "scene/integrate_scene.hpp"
#include "text/comma_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <map>

namespace lagen {

namespace {

constexpr std::size_t most_picture_times = 20001, most_picture_steps = 10000;

/// The run that is drawn.
struct PlottedRun {
    const Model& model;
    const Scene& scene; ///< with its form and its plot
    const RunRecord& record;
    const ProgramInput& input; ///< of the table
    std::size_t rows;          ///< that the table has
};

/// Another scene of the same model, changed by the command line as the last one was.
struct RunBeside {
    RunBeside(const Options& options, const CheckedModel& model, const Scene& scene)
        : checked(model), run(checked, scene, method_of(scene), options.has("at") && !options.has("t-end")),
          outcome(run.integrate(second_run_of(options)))
    {
    }
    CheckedModel checked;
    SceneRun run;
    RunOutcome outcome;
};

/// The curves of a panel, and what stands at its ordinate; without it the names of the curves do.
struct PlannedPanel {
    std::vector<PlotCurve> curves;
    std::string label;
};

/// The panels, each with the curves of one unit.
std::vector<PlannedPanel> by_unit(const Model& model, const std::vector<PlannedPanel>& panels)
{
    std::vector<PlannedPanel> parts;
    for (const PlannedPanel& panel : panels) {
        std::vector<std::string> units;
        const std::size_t first = parts.size();
        for (const PlotCurve& curve : panel.curves) {
            const std::string unit = symbol_of(model, curve.coordinates[1].name).unit;
            const auto place = static_cast<std::size_t>(std::ranges::find(units, unit) - units.begin());
            if (place == units.size()) {
                units.push_back(unit);
                parts.push_back({{}, panel.label});
            }
            parts[first + place].curves.push_back(curve);
        }
    }
    return parts;
}

/// The columns of the table over time: base coordinates, the rest of the state, first-order states, controls, and what
/// is observed besides, in a panel a unit.
std::vector<PlannedPanel> series_of(const PlottedRun& run)
{
    const Model& model = run.model;
    const std::size_t base_lanes = model.base.coordinates.size();
    const std::size_t motion_lanes = base_lanes + model.fibre.coordinates.size();
    std::vector<PlannedPanel> panels{{{}, "base coordinates"},
                                     {{}, form_named(run.scene.form).lanes},
                                     {{}, "states"},
                                     {{}, "controls"},
                                     {{}, "observables"}};
    const NamedTree time{"t", name("t"), {}};
    for (const TableColumn& column : run.input.columns) {
        const auto is_column = [&](const Symbol& symbol) { return symbol.name == column.name; };
        const bool control = model.control && std::ranges::any_of(model.control->controls, is_column);
        const std::size_t of_state = column.index < base_lanes ? 0 : column.index < motion_lanes ? 1 : 2;
        panels[column.state ? of_state : control ? 3 : 4].curves.push_back({{time, {column.name, nullptr, {}}}, {}});
    }
    return by_unit(model, panels);
}

std::vector<PlannedPanel> panels_of(const PlottedRun& run)
{
    if (!run.scene.plot) return series_of(run);
    std::vector<PlannedPanel> panels;
    for (const auto& curves : run.scene.plot->panels) panels.push_back({curves, ""});
    return panels;
}

/// The values of every coordinate by its name, one a row.
using Columns = std::map<std::string, std::vector<double>>;

/// Points at the rows of the scene, and nothing between them.
bool draws_points(const PlottedRun& run)
{
    return run.scene.sampling.kind == Sampling::Kind::event || (run.scene.plot && run.scene.plot->points);
}

/// The times of the picture.
void use_times(const PlottedRun& run, ProgramInput& input)
{
    if (draws_points(run)) return;
    SampleTimes& times = input.times;
    if (times.every > 0) {
        const std::size_t steps = (std::max<std::size_t>(run.rows, 1) - 1) * times.every;
        times.every = std::max<std::size_t>(1, (steps + most_picture_steps - 1) / most_picture_steps);
    } else if (times.start != times.end) {
        times.kind = Sampling::Kind::count;
        const auto fits = static_cast<std::size_t>(most_numbers) / (input.columns.size() + 1);
        times.count = std::max<std::size_t>(2, std::min(most_picture_times, fits));
    }
}

/// The times of jumps, the last one first. Curves are broken there.
std::vector<double> jumps_of(const RunOutcome& outcome)
{
    std::vector<double> times;
    for (const detail::FoundCrossing& event : outcome.events)
        if (!event.after.empty()) times.push_back(event.t);
    std::ranges::reverse(times);
    return times;
}

Columns columns_of_run(const PlottedRun& run, const std::vector<PlannedPanel>& panels)
{
    std::vector<std::string> names;
    for (const PlannedPanel& panel : panels)
        for (const PlotCurve& curve : panel.curves)
            for (const NamedTree& coordinate : curve.coordinates)
                if (coordinate.name != "t") names.push_back(coordinate.name);
    names = distinct(names);
    ProgramInput input = run.input;
    input.columns = columns_named(run.record.names, names);
    use_times(run, input);
    names.insert(names.begin(), "t");
    RunOutcome outcome;
    outcome.table.columns = names;
    integrate_scene(run.record.program, input, outcome);
    if (outcome.table.count() == 0 || panels.empty())
        throw MachineError("there is nothing to plot: the run gave no rows");
    Columns columns;
    std::vector<double> jumps = jumps_of(outcome); // those that no row is behind yet, the next one last
    for (std::size_t place = 0; place < outcome.table.count(); ++place) {
        const std::span<const double> row = outcome.table.row(place);
        const double time = row[0];
        const auto is_behind = [&](double jump) {
            return input.times.end < input.times.start ? time < jump : time > jump;
        };
        if (!jumps.empty() && is_behind(jumps.back()))
            for (const std::string& name : names) columns[name].push_back(std::numeric_limits<double>::quiet_NaN());
        while (!jumps.empty() && is_behind(jumps.back())) jumps.pop_back();
        for (std::size_t k = 0; k < names.size(); ++k) columns[names[k]].push_back(row[k]);
    }
    return columns;
}

SampledCurve sampled(const PlotCurve& curve, const Columns& columns)
{
    SampledCurve points(columns.at("t").size());
    for (std::size_t i = 0; i < curve.coordinates.size(); ++i) {
        const std::vector<double>& values = columns.at(curve.coordinates[i].name);
        for (std::size_t k = 0; k < points.size(); ++k) points[k][i] = values[k];
    }
    return points;
}

/// Graphs over t that differ from their starts by less than this part of their size become the changes from there: no
/// axis has room for so many digits. True where they do.
bool show_changes(std::vector<SampledCurve>& curves)
{
    constexpr double hardly = 1e-4;
    const PlotBox box = box_of(curves);
    const double height = box.high[1] - box.low[1];
    if (!(height > 0) || height >= hardly * std::max(std::fabs(box.low[1]), std::fabs(box.high[1]))) return false;
    for (SampledCurve& curve : curves) {
        const double start = curve.empty() ? 0 : curve[0][1];
        for (PlotPoint& point : curve) point[1] -= start;
    }
    return true;
}

/// The curves of one run after those of another, with their names or that of their run.
Panel panel_of(const std::vector<PlottedRun>& runs, const PlannedPanel& planned, const std::vector<Columns>& columns)
{
    const PlottedRun& first = runs.front();
    const std::optional<Plot>& plot = first.scene.plot;
    std::vector<std::vector<Symbol>> symbols, along(planned.curves.front().coordinates.size());
    for (const PlotCurve& curve : planned.curves) {
        std::vector<Symbol>& row = symbols.emplace_back();
        for (const NamedTree& coordinate : curve.coordinates) {
            row.push_back(symbol_of(first.model, coordinate.name));
            if (curve.coordinates.size() > 2) row.back().text.clear(); // there is no room at the axes of space
            along[row.size() - 1].push_back(row.back());
        }
    }
    Panel panel;
    panel.over_time = std::ranges::all_of(along[0], [](const Symbol& each) { return each.name == "t"; });
    panel.equal = plot && plot->equal && !panel.over_time;
    panel.pen = draws_points(first) ? Pen::points : first.input.times.every > 0 ? Pen::steps : Pen::line;
    if (plot) panel.sphere = plot->sphere;
    const std::vector<std::string> names = legends_of(symbols);
    for (std::size_t k = 0; k < runs.size(); ++k)
        for (std::size_t j = 0; j < planned.curves.size(); ++j) {
            panel.curves.push_back(sampled(planned.curves[j], columns[k]));
            const std::string run = runs.size() > 1 ? runs[k].scene.name : "";
            panel.legends.push_back(comma_list(std::array{names[j], run}));
        }
    for (const std::vector<Symbol>& axis : along) panel.labels.push_back(axis_label(axis));
    if (!planned.label.empty() && planned.curves.size() > 1) panel.labels[1] = panel_label(planned.label, along[1]);
    if (panel.over_time && show_changes(panel.curves)) panel.labels[1] = "change of " + panel.labels[1];
    return panel;
}

bool is_picture(const std::string& path)
{
    const std::string extension = picture_extension(path);
    return extension == ".svg" || extension == ".png" || extension == ".pdf";
}

} // namespace

void require_no_picture(const std::string& path)
{
    if (is_picture(path))
        throw UsageError(fmt::format("--output writes the rows as CSV; a picture is `--plot {}`", path));
}

void require_plot_format(const std::string& path)
{
    if (!is_picture(path))
        throw UsageError(fmt::format("--plot needs a file that ends in .svg, .png or .pdf, found '{}'", path));
    if (find_program("gnuplot").empty())
        throw MachineError("gnuplot was not found", "--plot draws with gnuplot; install gnuplot-nox");
}

std::string draw_scene(const Options& options, const SceneRun& run, const RunOutcome& outcome,
                       const std::vector<std::string>& beside, bool& whole)
{
    std::vector<PlottedRun> runs{{run.checked().model, run.scene(), run.record(), run.input(), outcome.table.count()}};
    std::list<RunBeside> others;
    for (const std::string& name : beside) {
        Scene scene = scene_of(options, run.checked().model, options.named("initial"), name);
        scene.plot = run.scene().plot;
        scene.observe = run.scene().observe;
        scene.states = run.scene().states;
        const RunBeside& other = others.emplace_back(options, run.checked(), scene);
        if (is_interrupted(other.outcome)) throw InterruptedError("lagen: interrupted while drawing");
        runs.push_back({other.checked.model, other.run.scene(), other.run.record(), other.run.input(),
                        other.outcome.table.count()});
        whole = whole && succeeded(other.outcome.status);
        write_standard_error(report_text(other.outcome) + run_warnings(other.outcome));
    }
    const std::vector<PlannedPanel> planned = panels_of(runs.front());
    std::vector<Columns> columns;
    for (const PlottedRun& each : runs) columns.push_back(columns_of_run(each, planned));
    std::vector<Panel> panels;
    std::size_t curves = 0;
    for (const PlannedPanel& each : planned) {
        panels.push_back(panel_of(runs, each, columns));
        curves += panels.back().curves.size();
    }
    const Model& model = run.checked().model;
    draw_panels(panels, model.title.empty() ? model.name : model.title, options.get("plot"));
    return count_text(panels.size(), "panel") + ", " + count_text(curves, "curve");
}

std::vector<std::string> scenes_beside(const Options& options, const Model& model, const Scene& last)
{
    std::vector<std::string> names = options.all("scene");
    if (names.size() < 2) return {};
    for (const char* word : {"accuracy", "bind", "branch", "variations", "jacobi-field"})
        if (options.has(word)) throw UsageError(fmt::format("--{} is of one run, and --scene names several", word));
    if (!options.has("plot"))
        throw UsageError("several scenes are drawn into one picture: give --plot FILE.svg as well");
    for (const std::string& name : names) {
        if (std::ranges::count(names, name) > 1) throw UsageError(fmt::format("--scene names '{}' twice", name));
        const Scene scene = scene_of(options, model, options.named("initial"), name);
        if (scene.form != last.form)
            throw UsageError(fmt::format("a picture is of runs of one form, and scene '{}' is run in the form '{}', "
                                         "scene '{}' in the form '{}'",
                                         last.name, last.form, scene.name, scene.form),
                             fmt::format("--form {}", last.form));
    }
    names.pop_back();
    return names;
}

} // namespace lagen
