// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/report.hpp"
#include "commands/chart/stability_chart.hpp"
#include "commands/scene/table.hpp"
#include "text/record.hpp"

#include <fmt/core.h>

#include <algorithm>

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
    text +=
        fmt::format("\nfollowed: {}\n\n{:<14}", chart.followed.empty() ? "the size of the state" : chart.followed, "");
    for (const OutcomeEntry& outcome : outcome_table) text += fmt::format("{:>16}", outcome.name);
    text += fmt::format("{:>16}{:>16}\n", "bounded up to", "least limit");
    for (const ChartedMethod& method : chart.methods) {
        text += fmt::format("{:<14}", method.name);
        for (const OutcomeEntry& outcome : outcome_table)
            text += fmt::format("{:>16}", std::ranges::count(method.cells, outcome.name, &StabilityCell::outcome));
        std::optional<double> least;
        for (const std::optional<double>& limit : method.limits)
            if (limit && (!least || *limit < *least)) least = limit;
        text +=
            fmt::format("{:>16.6g}{:>16}\n", bounded_up_to(chart, method), least ? fmt::format("{:.6g}", *least) : "-");
    }
    if (!chart.left_out.empty()) text += "\n";
    for (const LeftOutMethod& method : chart.left_out) text += fmt::format("left out: {}\n", method.reason);
    return text;
}

} // namespace lagen
