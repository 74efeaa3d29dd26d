// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/report.hpp"

#include "text/record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

Record record_of(const ChartPoint& point)
{
    Record record = Record::object();
    add_unless_empty(record, "peer", point.peer);
    record.update({{"method", point.method},
                   {"parameter", point.parameter},
                   {"error", or_null(point.error)},
                   {"invariants", object_of(point.drifts, [](double drift) { return drift; })},
                   {"seconds", point.seconds},
                   {"spread", point.spread},
                   {"rhs_calls", point.rhs_calls},
                   {"steps", point.steps},
                   {"rejected", point.rejected},
                   {"status", point.status}});
    return record;
}

/// The cheapest point of each error that is reached.
Record best_of(const Chart& chart)
{
    Record list = Record::array();
    for (const double error : charted_errors) {
        const ChartPoint* best = cheapest_within(chart.points, error);
        if (best == nullptr) continue;
        Record each = {{"error", error}};
        add_unless_empty(each, "peer", best->peer);
        each.update({{"method", best->method},
                     {"parameter", best->parameter},
                     {"seconds", best->seconds},
                     {"rhs_calls", best->rhs_calls},
                     {"steps", best->steps}});
        list.push_back(std::move(each));
    }
    return list;
}

std::vector<std::string> drift_names(const Chart& chart)
{
    std::vector<std::string> names;
    for (const ChartPoint& point : chart.points)
        for (const auto& [name, drift] : point.drifts)
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    return names;
}

std::string best_lines(const Chart& chart)
{
    std::string text = "error  method          tolerance or step   its error  seconds   right-hand sides  steps\n";
    for (const double error : charted_errors) {
        const ChartPoint* best = cheapest_within(chart.points, error);
        text += best == nullptr
                    ? fmt::format("{:<7.0e}not reached\n", error)
                    : fmt::format("{:<7.0e}{:<16}{:<20}{:<11.1e}{:<10.2e}{:<18}{}\n", error, name_of(*best),
                                  parameter_text(*best), *best->error, best->seconds, best->rhs_calls, best->steps);
    }
    return text;
}

/// "error 1e-06: dop853 takes 0.57 of the time of odeint fehlberg78", one line an error, where peers were charted.
std::string peer_lines(const Chart& chart)
{
    std::vector<ChartPoint> own, peers;
    for (const ChartPoint& point : chart.points) (point.peer.empty() ? own : peers).push_back(point);
    std::string text;
    for (const double error : charted_errors) {
        const ChartPoint* ours = cheapest_within(own, error);
        const ChartPoint* theirs = cheapest_within(peers, error);
        if (ours == nullptr || theirs == nullptr) continue;
        text += fmt::format("error {:.0e}: {} takes {:.2f} of the time of {}\n", error, ours->method,
                            ours->seconds / theirs->seconds, name_of(*theirs));
    }
    return text.empty() ? text : text + "\n";
}

/// What each method takes for each error, in seconds.
std::string method_lines(const Chart& chart)
{
    std::string text = "seconds for an error of";
    for (const double error : charted_errors) text += fmt::format("{:>10.0e}", error);
    text += '\n';
    for (const std::string& name : charted_methods(chart)) {
        std::vector<ChartPoint> own;
        for (const ChartPoint& point : chart.points)
            if (name_of(point) == name) own.push_back(point);
        text += fmt::format("  {:<21}", name);
        for (const double error : charted_errors) {
            const ChartPoint* best = cheapest_within(own, error);
            text += best == nullptr ? fmt::format("{:>10}", "-") : fmt::format("{:>10.1e}", best->seconds);
        }
        text += '\n';
    }
    return text;
}

/// "failed: gauss2, step 0.4: newton_diverged", one line a method and status.
std::string failure_lines(const Chart& chart)
{
    std::string text;
    for (std::size_t k = 0; k < chart.points.size();) {
        const ChartPoint& first = chart.points[k];
        std::size_t end = k;
        while (end < chart.points.size() && name_of(chart.points[end]) == name_of(first) &&
               chart.points[end].status == first.status)
            ++end;
        if (!first.error) {
            text += fmt::format("failed: {}, {}", name_of(first), parameter_text(first));
            if (end - k > 1) text += fmt::format(" to {:.2g}", chart.points[end - 1].parameter);
            text += fmt::format(": {}\n", first.status);
        }
        k = end;
    }
    return text;
}

double median_spread(const Chart& chart)
{
    std::vector<double> spreads;
    for (const ChartPoint& point : chart.points) spreads.push_back(point.spread);
    std::ranges::sort(spreads);
    return spreads.empty() ? 1 : spreads[spreads.size() / 2];
}

} // namespace

std::string name_of(const ChartPoint& point)
{
    return point.peer.empty() ? point.method : point.peer + " " + point.method;
}

std::string parameter_text(const ChartPoint& point)
{
    const MethodEntry* method = point.peer.empty() ? find_method(point.method) : nullptr;
    return fmt::format("{} {:.2g}", method == nullptr || method->adaptive ? "tolerance" : "step", point.parameter);
}

std::vector<std::string> charted_methods(const Chart& chart)
{
    std::vector<std::string> names;
    for (const ChartPoint& point : chart.points)
        if (std::ranges::find(names, name_of(point)) == names.end()) names.push_back(name_of(point));
    return names;
}

std::vector<std::string> charted_invariants(const Chart& chart)
{
    std::vector<std::string> names = drift_names(chart);
    if (chart.energy_changes)
        std::erase_if(names, [](const std::string& name) { return name == "energy" || name == "hamiltonian"; });
    return names;
}

Record record_of(const std::vector<LeftOutMethod>& left_out)
{
    return list_of(left_out, [](const LeftOutMethod& each) {
        return Record{{"method", each.method}, {"reason", each.reason}};
    });
}

std::string chart_json(const Chart& chart)
{
    Record record = {{"model", chart.model}, {"scene", chart.scene}, {"form", chart.form},
                     {"start", chart.start}, {"end", chart.end},     {"times", chart.times}};
    add_unless_empty(record, "shortened", chart.shortened);
    record.update({{"reference", {{"error", chart.reference_error}, {"methods", chart.reference_methods}}},
                   {"machine", chart.machine},
                   {"compiler", chart.compiler},
                   {"repeats", chart.repeats},
                   {"points", list_of(chart.points, [](const ChartPoint& point) { return record_of(point); })},
                   {"best", best_of(chart)},
                   {"left_out", record_of(chart.left_out)}});
    return to_json(record) + "\n";
}

std::string chart_csv(const Chart& chart)
{
    const std::vector<std::string> names = drift_names(chart);
    std::string text = "peer,method,parameter,status,error,seconds,spread,rhs_calls,steps,rejected";
    for (const std::string& name : names) text += ",drift_" + name;
    for (const ChartPoint& point : chart.points) {
        text += fmt::format("\r\n{},{},{},{},{},{},{},{},{},{}", point.peer, point.method, point.parameter,
                            point.status, point.error ? fmt::format("{}", *point.error) : "", point.seconds,
                            point.spread, point.rhs_calls, point.steps, point.rejected);
        for (const std::string& name : names) {
            const auto drift = std::ranges::find(point.drifts, name, &std::pair<std::string, double>::first);
            const bool known = drift != point.drifts.end() && std::isfinite(drift->second);
            text += known ? fmt::format(",{}", drift->second) : ",";
        }
    }
    return text + "\r\n";
}

std::string chart_text(const Chart& chart)
{
    std::string text = fmt::format("{}, scene {}, {} form, {} samples from t = {:.9g} to {:.9g}\n", chart.model,
                                   chart.scene, chart.form, chart.times.size(), chart.start, chart.end);
    if (!chart.shortened.empty()) text += fmt::format("the chart ends at t = {:.9g}: {}\n", chart.end, chart.shortened);
    text += fmt::format("reference: {} and {} in 113 bits differ by {:.1e}\n", chart.reference_methods[0],
                        chart.reference_methods[1], chart.reference_error);
    text += fmt::format("machine: {}; {}; least of {} repeats, of which the largest is {:.2f} times that in the "
                        "median\n\n",
                        chart.machine, chart.compiler, chart.repeats, median_spread(chart));
    text += best_lines(chart) + "\n" + peer_lines(chart) + method_lines(chart);
    const std::string failures = failure_lines(chart);
    if (!failures.empty() || !chart.left_out.empty()) text += "\n" + failures;
    for (const LeftOutMethod& method : chart.left_out)
        text += fmt::format("left out: {}{}\n", method.reason.starts_with(method.method) ? "" : method.method + ": ",
                            method.reason);
    return text;
}

} // namespace lagen
