// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/report.hpp"
#include "commands/chart/stability_chart.hpp"
#include "machine/gnuplot.hpp"
#include "scene/table.hpp"
#include "text/record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

/// The words of the table with the lengths and quantities of this chart.
Record criteria_of(const StabilityChart& chart)
{
    Record criteria = {
        {"followed", chart.followed.empty() ? "the largest entry of the state" : chart.followed},
        {"scale", chart.followed.empty()
                      ? "its largest value along the motion"
                      : "the largest difference along the motion that setting velocities or momenta to 0 "
                        "makes: of an energy, the kinetic energy"}};
    for (const OutcomeEntry& outcome : outcome_table) criteria[outcome.name] = outcome.criterion;
    criteria["limit"] = "the step at which the fastest oscillation along the motion, omega, reaches the end of the "
                        "method's interval on x'' = -omega^2 x, or of a discrete motion that from which on the momenta "
                        "of the start have no arrow; null where there is no such step, or none is known";
    return criteria;
}

/// A list a step, with the value of `part` for each cell.
template <class Part>
Record cells_of(const StabilityChart& chart, const ChartedMethod& method, Part part)
{
    Record rows = Record::array();
    for (std::size_t i = 0; i < chart.axes[0].values.size(); ++i) {
        Record row = Record::array();
        for (std::size_t j = 0; j < chart.columns.size(); ++j) row.push_back(chart.cell(method, i, j).*part);
        rows.push_back(std::move(row));
    }
    return rows;
}

bool has_drift(const StabilityCell& cell)
{
    return cell.outcome == "bounded" || cell.outcome == "drifting";
}

/// The longest step up to which every point of the method is bounded; 0 where the shortest is not.
double bounded_up_to(const StabilityChart& chart, const ChartedMethod& method)
{
    std::vector<std::pair<double, std::size_t>> steps;
    for (std::size_t i = 0; i < chart.axes[0].values.size(); ++i) steps.emplace_back(chart.axes[0].values[i], i);
    std::ranges::sort(steps);
    double longest = 0;
    for (const auto& [step, i] : steps) {
        for (std::size_t j = 0; j < chart.columns.size(); ++j)
            if (chart.cell(method, i, j).outcome != "bounded") return longest;
        longest = step;
    }
    return longest;
}

constexpr int picture_width = 1240, panel_height = 226, head_height = 64, row_height = 26, most_columns = 5; // pixels

const OutcomeEntry& outcome_named(const std::string& name)
{
    const auto found =
        std::ranges::find(outcome_table, name, [](const OutcomeEntry& o) { return std::string(o.name); });
    return found == outcome_table.end() ? outcome_table.back() : *found;
}

/// Half-way to the neighbours of value k, as far on the other side at an end; a tenth where it is alone.
std::pair<double, double> cell_ends(const std::vector<double>& values, std::size_t k)
{
    if (values.size() == 1) {
        const double half = values[k] == 0 ? 1 : 0.1 * std::abs(values[k]);
        return {values[k] - half, values[k] + half};
    }
    const double before = k > 0 ? values[k] - values[k - 1] : values[k + 1] - values[k];
    const double after = k + 1 < values.size() ? values[k + 1] - values[k] : before;
    return {values[k] - before / 2, values[k] + after / 2};
}

/// Boxes of equal outcomes along the steps of a column, "x y x0 x1 y0 y1 colour" a line.
std::string boxes_of(const StabilityChart& chart, const ChartedMethod& method, std::size_t j, double low, double high)
{
    const std::vector<double>& steps = chart.axes[0].values;
    std::string text;
    for (std::size_t begin = 0; begin < steps.size();) {
        const std::string& outcome = chart.cell(method, begin, j).outcome;
        std::size_t end = begin + 1;
        while (end < steps.size() && chart.cell(method, end, j).outcome == outcome) ++end;
        const double from = cell_ends(steps, begin).first, to = cell_ends(steps, end - 1).second;
        text += fmt::format("{:.7g} {:.7g} {:.7g} {:.7g} {:.7g} {:.7g} 0x{}\n", (from + to) / 2, (low + high) / 2, from,
                            to, low, high, outcome_named(outcome).colour + 1);
        begin = end;
    }
    return text;
}

/// Points of the limit; an empty line where there is none.
std::string limit_points(const StabilityChart& chart, const ChartedMethod& method)
{
    std::string text;
    for (std::size_t j = 0; j < method.limits.size(); ++j)
        text += method.limits[j] ? fmt::format("{:.7g} {:.7g}\n", *method.limits[j], chart.axes[1].values[j]) : "\n";
    return text;
}

std::string block(const std::string& name, const std::string& lines)
{
    return fmt::format("${} << LAGEN_END\n{}LAGEN_END\n", name, lines);
}

/// The name of the black line.
const char* limit_name(const StabilityChart& chart)
{
    const auto meets_fold = [](const ChartedMethod& method) {
        return std::ranges::any_of(method.folds, [](double fold) { return fold > 0; });
    };
    return std::ranges::any_of(chart.methods, meets_fold) ? "end of the linear interval, or a fold"
                                                          : "end of the linear interval, h omega";
}

/// The key names the outcomes once, in a line at the top.
std::string key_plots(const StabilityChart& chart)
{
    std::string text;
    for (const OutcomeEntry& outcome : outcome_table)
        text += fmt::format(", NaN with points pointtype 5 pointsize 1.6 linecolor rgb '{}' title {}", outcome.colour,
                            gnuplot_text(outcome.name));
    return text + fmt::format(", NaN with lines linecolor rgb 'black' linewidth 1.8 title {}",
                              gnuplot_text(limit_name(chart)));
}

/// Panels in `rows` rows between the key and the bottom.
std::string common_script(const StabilityChart& chart, const std::string& picture, int rows, int columns, int row)
{
    const int height = head_height + rows * row + row_height;
    const std::string title =
        fmt::format("{}, scene {}, t = {:.6g} to {:.6g}, {} form; followed: {}",
                    chart.title.empty() ? chart.model : chart.title, chart.scene, chart.start, chart.end, chart.form,
                    chart.followed.empty() ? "the size of the state" : chart.followed);
    return gnuplot_terminal(picture_extension(picture), picture_width, height) +
           fmt::format(
               "set output {}\nset multiplot layout {},{} margins {},0.99,{:.4f},{:.4f} spacing 0.021,{:.4f} title "
               "{}\nset key at screen 0.5,{:.4f} center top horizontal Left reverse maxrows 1\n",
               gnuplot_text(picture), rows, columns, columns == 1 ? 0.12 : 0.06, 46.0 / height,
               1 - (head_height + 20.0) / height, 50.0 / height, gnuplot_text(title), 1 - 30.0 / height) +
           "set border 15 linecolor rgb '#444444'\nset tics out nomirror scale 0.5 font ',10'\n"
           "set style fill solid 1 border\nset xtics autofreq\n";
}

constexpr const char* draw_boxes = "using 1:2:3:4:5:6:7 with boxxyerror linecolor rgb variable notitle";

/// A panel a method, the second axis upwards.
std::string panels_script(const StabilityChart& chart, const std::string& picture)
{
    const int count = static_cast<int>(chart.methods.size()), panel_columns = std::clamp(count, 2, most_columns);
    const int rows = (count + panel_columns - 1) / panel_columns;
    const std::vector<double>&steps = chart.axes[0].values, &values = chart.axes[1].values;
    std::string text = common_script(chart, picture, rows, panel_columns, panel_height);
    text += fmt::format("set xrange [{:.7g}:{:.7g}]\nset yrange [{:.7g}:{:.7g}]\n", cell_ends(steps, 0).first,
                        cell_ends(steps, steps.size() - 1).second, cell_ends(values, 0).first,
                        cell_ends(values, values.size() - 1).second);
    for (int k = 0; k < count; ++k) {
        const ChartedMethod& method = chart.methods[static_cast<std::size_t>(k)];
        std::string boxes;
        for (std::size_t j = 0; j < values.size(); ++j) {
            const auto [low, high] = cell_ends(values, j);
            boxes += boxes_of(chart, method, j, low, high);
        }
        text += fmt::format("set title {} offset 0,-0.8 font ',11'\n", gnuplot_text(method.name));
        text += k + panel_columns >= count ? "set xlabel 'step' offset 0,0.6\n" : "unset xlabel\n";
        text += k % panel_columns == 0
                    ? fmt::format("set ylabel {} offset 0.4,0\nset format y '%g'\n", gnuplot_text(chart.axes[1].name))
                    : "unset ylabel\nset format y ''\n";
        text += block(fmt::format("boxes{}", k), boxes) + block(fmt::format("limit{}", k), limit_points(chart, method));
        const bool limited = std::ranges::any_of(method.limits, [](const auto& limit) { return limit.has_value(); });
        text += fmt::format("plot $boxes{} {}", k, draw_boxes);
        if (limited) text += fmt::format(", $limit{} with lines linecolor rgb 'black' linewidth 1.8 notitle", k);
        text += (k == 0 ? key_plots(chart) : "") + "\n";
    }
    return text + "unset multiplot\nunset output\n";
}

/// A row a method.
std::string rows_script(const StabilityChart& chart, const std::string& picture)
{
    const std::size_t count = chart.methods.size();
    const std::vector<double>& steps = chart.axes[0].values;
    std::string text = common_script(chart, picture, 1, 1, static_cast<int>(count) * row_height + 40);
    std::string boxes, limits, tics;
    for (std::size_t k = 0; k < count; ++k) {
        const double y = static_cast<double>(count - k);
        boxes += boxes_of(chart, chart.methods[k], 0, y - 0.4, y + 0.4);
        if (chart.methods[k].limits[0])
            limits +=
                fmt::format("{0:.7g} {1:.7g}\n{0:.7g} {2:.7g}\n\n", *chart.methods[k].limits[0], y - 0.48, y + 0.48);
        tics += fmt::format("{}{} {:g}", k == 0 ? "" : ", ", gnuplot_text(chart.methods[k].name), y);
    }
    text += fmt::format("set xrange [{:.7g}:{:.7g}]\nset yrange [0.4:{:g}]\nset ytics ({})\nset xlabel 'step'\n",
                        cell_ends(steps, 0).first, cell_ends(steps, steps.size() - 1).second,
                        static_cast<double>(count) + 0.6, tics);
    text += block("boxes", boxes) + block("limits", limits) + fmt::format("plot $boxes {}", draw_boxes);
    if (!limits.empty()) text += ", $limits with lines linecolor rgb 'black' linewidth 2.2 notitle";
    return text + key_plots(chart) + "\nunset multiplot\nunset output\n";
}

} // namespace

std::string stability_json(const StabilityChart& chart)
{
    Record methods = Record::object();
    for (const ChartedMethod& method : chart.methods)
        methods[method.name] = {{"outcome", cells_of(chart, method, &StabilityCell::outcome)},
                                {"status", cells_of(chart, method, &StabilityCell::status)},
                                {"limit", list_of(method.limits, [](const auto& limit) { return or_null(limit); })}};
    const Record record = {{"model", chart.model},
                           {"scene", chart.scene},
                           {"form", chart.form},
                           {"start", chart.start},
                           {"end", chart.end},
                           {"axes", list_of(chart.axes,
                                            [](const StabilityAxis& axis) {
                                                return Record{{"name", axis.name}, {"values", axis.values}};
                                            })},
                           {"omega", list_of(chart.columns, [](const ColumnFigures& column) { return column.omega; })},
                           {"methods", methods},
                           {"criteria", criteria_of(chart)},
                           {"left_out", record_of(chart.left_out)}};
    return to_json(record) + "\n";
}

std::string stability_csv(const StabilityChart& chart)
{
    const bool two = chart.axes.size() > 1;
    std::string text = "method,step";
    if (two) text += "," + chart.axes[1].heading;
    text += ",outcome,t,error,drift,status";
    for (const ChartedMethod& method : chart.methods)
        for (std::size_t j = 0; j < chart.columns.size(); ++j)
            for (std::size_t i = 0; i < chart.axes[0].values.size(); ++i) {
                const StabilityCell& cell = chart.cell(method, i, j);
                text += fmt::format("\r\n{},{}", method.name, chart.axes[0].values[i]);
                if (two) text += fmt::format(",{}", chart.axes[1].values[j]);
                text += fmt::format(",{},{},{},{},{}", cell.outcome, cell.t, cell.error,
                                    has_drift(cell) ? fmt::format("{}", cell.drift) : "", cell.status);
            }
    return text + "\r\n";
}

std::string stability_text(const StabilityChart& chart)
{
    std::string text =
        fmt::format("{}, scene {}, {} form, t = {:.9g} to {:.9g}, steps {:.6g} to {:.6g}", chart.model, chart.scene,
                    chart.form, chart.start, chart.end, chart.axes[0].values.front(), chart.axes[0].values.back());
    if (chart.axes.size() > 1)
        text += fmt::format(", {} {:.6g} to {:.6g}", chart.axes[1].name, chart.axes[1].values.front(),
                            chart.axes[1].values.back());
    text += fmt::format("\nfollowed: {}\n\n", chart.followed.empty() ? "the size of the state" : chart.followed);
    std::vector<std::vector<std::string>> rows{{""}};
    for (const OutcomeEntry& outcome : outcome_table) rows[0].emplace_back(outcome.name);
    rows[0].insert(rows[0].end(), {"bounded up to", "least limit"});
    for (const ChartedMethod& method : chart.methods) {
        std::vector<std::string>& row = rows.emplace_back(std::vector{method.name});
        for (const OutcomeEntry& outcome : outcome_table)
            row.push_back(std::to_string(std::ranges::count(method.cells, outcome.name, &StabilityCell::outcome)));
        std::optional<double> least;
        for (const std::optional<double>& limit : method.limits)
            if (limit && (!least || *limit < *least)) least = limit;
        row.push_back(value_text(bounded_up_to(chart, method), ".6g"));
        row.push_back(least ? value_text(*least, ".6g") : "-");
    }
    text += in_columns(rows, "<>", "");
    if (!chart.left_out.empty()) text += "\n";
    for (const LeftOutMethod& method : chart.left_out) text += fmt::format("left out: {}\n", method.reason);
    return text;
}

void draw_stability(const StabilityChart& chart, const std::string& path)
{
    draw_picture(path, [&](const std::string& picture) {
        return chart.axes.size() > 1 ? panels_script(chart, picture) : rows_script(chart, picture);
    });
}

} // namespace lagen
