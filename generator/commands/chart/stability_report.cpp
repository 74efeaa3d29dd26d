// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/stability_chart.hpp"
#include "commands/scene/table.hpp"
#include "emit/json.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

/// The words of the table with the lengths and quantities of this chart.
void criteria_json(JsonWriter& json, const StabilityChart& chart)
{
    json.key("criteria").begin_object();
    json.key("followed").value(chart.followed.empty() ? "the largest entry of the state" : chart.followed);
    json.key("scale").value(chart.followed.empty()
                                ? "its largest value along the motion"
                                : "the largest difference along the motion that setting velocities or momenta to 0 "
                                  "makes: of an energy, the kinetic energy");
    for (const OutcomeEntry& outcome : outcome_table) json.key(outcome.name).value(outcome.criterion);
    json.key("limit").value(
        "the step at which the fastest oscillation along the motion, omega, reaches the end of the "
        "method's interval on x'' = -omega^2 x, or of a discrete motion that from which on the momenta of "
        "the start have no arrow; null where there is no such step, or none is known");
    json.end_object();
}

void optional_json(JsonWriter& json, const std::optional<double>& number)
{
    if (number)
        json.value(*number);
    else
        json.null();
}

void methods_json(JsonWriter& json, const StabilityChart& chart)
{
    const std::size_t steps = chart.axes[0].values.size();
    json.key("methods").begin_object();
    for (const ChartedMethod& method : chart.methods) {
        json.key(method.name).begin_object().key("outcome").begin_array();
        for (std::size_t i = 0; i < steps; ++i) {
            json.begin_array();
            for (std::size_t j = 0; j < chart.columns.size(); ++j) json.value(chart.cell(method, i, j).outcome);
            json.end_array();
        }
        json.end_array().key("status").begin_array();
        for (std::size_t i = 0; i < steps; ++i) {
            json.begin_array();
            for (std::size_t j = 0; j < chart.columns.size(); ++j) json.value(chart.cell(method, i, j).status);
            json.end_array();
        }
        json.end_array().key("limit").begin_array();
        for (const std::optional<double>& limit : method.limits) optional_json(json, limit);
        json.end_array().end_object();
    }
    json.end_object();
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
    JsonWriter json;
    json.begin_object().key("model").value(chart.model).key("scene").value(chart.scene).key("form").value(chart.form);
    json.key("start").value(chart.start).key("end").value(chart.end).key("axes").begin_array();
    for (const StabilityAxis& axis : chart.axes) {
        json.begin_object().key("name").value(axis.name).key("values").begin_array();
        for (const double value : axis.values) json.value(value);
        json.end_array().end_object();
    }
    json.end_array().key("omega").begin_array();
    for (const ColumnFigures& column : chart.columns) json.value(column.omega);
    json.end_array();
    methods_json(json, chart);
    criteria_json(json, chart);
    json.key("left_out").begin_array();
    for (const LeftOutMethod& method : chart.left_out)
        json.begin_object().key("method").value(method.method).key("reason").value(method.reason).end_object();
    json.end_array().end_object();
    return json.text() + "\n";
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
