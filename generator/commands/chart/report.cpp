// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/report.hpp"

#include "machine/gnuplot.hpp"
#include "text/comma_list.hpp"
#include "text/record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

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
        for (const auto& [name, drift] : point.drifts) names.push_back(name);
    return distinct(names);
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

constexpr int chart_width = 1240, chart_height = 600;    // pixels
constexpr double name_width = 0.18, name_height = 0.023; ///< of a panel
constexpr double largest_error = 10;                     ///< of the picture
constexpr double failures_at = 30;                       ///< times the largest that is shown: where failures are drawn
constexpr double near_the_best = 1.1;                    ///< times the cheapest: a method that leads
constexpr std::size_t most_invariants = 4;               ///< with panels of their own
constexpr double least_shown = 1e-17;

using Measure = std::function<double(const ChartPoint&)>;

struct Curve {
    std::string name;
    std::vector<const ChartPoint*> points; ///< with errors, the largest first
    std::vector<const ChartPoint*> failures;
    bool leads = false, peer = false;
};

/// Leading methods in their order, then the others.
std::vector<Curve> curves_of(const Chart& chart, const std::vector<std::string>& leading)
{
    std::vector<std::string> names = leading;
    for (std::string& name : charted_methods(chart))
        if (std::ranges::find(leading, name) == leading.end()) names.push_back(std::move(name));
    std::vector<Curve> curves;
    for (const std::string& name : names) {
        Curve curve{name, {}, {}, curves.size() < leading.size()};
        for (const ChartPoint& point : chart.points) {
            if (name_of(point) != name) continue;
            (point.error ? curve.points : curve.failures).push_back(&point);
            curve.peer = !point.peer.empty();
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

/// Colours of lagen's curves that do not lead, and of peers.
constexpr const char* quiet_colours[] = {"#9a9a9a", "#b3a17c", "#8fa3bf"};
constexpr const char* peer_colours[] = {"#5a5a5a", "#7d5a2b", "#3d5a80"};

const char* colour_of(const Curve& curve, std::size_t k)
{
    if (curve.leads) return picture_colours[k % picture_colours.size()];
    return curve.peer ? peer_colours[k % std::size(peer_colours)] : quiet_colours[k % std::size(quiet_colours)];
}

/// Thick with points where it leads, dashed with points for a peer, else a thin line.
std::string style_of(const Curve& curve, std::size_t k)
{
    const std::string line =
        fmt::format("linecolor rgb '{}' linewidth {} dashtype {}", colour_of(curve, k), curve.leads ? 2.4 : 1,
                    curve.peer    ? 2
                    : curve.leads ? k / picture_colours.size() + 1
                                  : 1);
    if (!curve.leads && !curve.peer && curve.points.size() > 1) return "with lines " + line;
    constexpr std::size_t shapes[] = {7, 5, 9, 11, 13, 4, 6, 8, 10, 12};
    return fmt::format("with linespoints {} pointtype {} pointsize {}", line, shapes[k % std::size(shapes)],
                       curve.leads ? 0.55 : 0.45);
}

/// One quantity charted over another, and the decades of both axes.
struct ChartPanel {
    std::string x_label, y_label;
    Measure x, y;                                     ///< x of points with an error
    double largest = largest_error;                   ///< x that is shown
    double worst = 0, least = 0, bottom = 0, top = 0; ///< log10

    [[nodiscard]] double shown(const ChartPoint& point) const
    {
        return point.error ? std::clamp(x(point), least_shown, largest) : failures_at * largest;
    }
    /// From the corner with the largest error and the least seconds, in parts of the panel.
    [[nodiscard]] std::pair<double, double> place(const ChartPoint& point) const
    {
        return {(worst - std::log10(shown(point))) / (worst - least), (std::log10(y(point)) - bottom) / (top - bottom)};
    }
};

double error_shown(const ChartPoint& point)
{
    return *point.error;
}

double seconds_shown(const ChartPoint& point)
{
    return point.seconds;
}

double calls_shown(const ChartPoint& point)
{
    return static_cast<double>(std::max<std::size_t>(point.rhs_calls, 1));
}

/// The drift of the invariant `name`; a drift that is not known or not finite counts as the worst.
Measure drift_shown(const std::string& name)
{
    return [name](const ChartPoint& point) {
        const auto found = std::ranges::find(point.drifts, name, &std::pair<std::string, double>::first);
        return found == point.drifts.end() || !std::isfinite(found->second) ? HUGE_VAL : found->second;
    };
}

/// Ten times what nine tenths of the points stay below, as a power of ten.
double largest_drift(const Chart& chart, const Measure& drift)
{
    std::vector<double> drifts;
    for (const ChartPoint& point : chart.points)
        if (point.error && std::isfinite(drift(point))) drifts.push_back(drift(point));
    std::ranges::sort(drifts);
    if (drifts.empty()) return largest_error;
    return std::pow(10, std::ceil(std::log10(std::max(10 * drifts[drifts.size() * 9 / 10], 1e-12))));
}

/// The limits of both axes.
ChartPanel fitted(const Chart& chart, ChartPanel panel)
{
    double least = 1e-3 * panel.largest / largest_error, bottom = HUGE_VAL, top = 0;
    bool failed = false;
    for (const ChartPoint& point : chart.points) {
        failed = failed || !point.error;
        if (point.error) least = std::min(least, panel.shown(point));
        bottom = std::min(bottom, panel.y(point));
        top = std::max(top, panel.y(point));
    }
    panel.worst = std::log10((failed ? 7 * failures_at : 1) * panel.largest);
    panel.least = std::floor(std::log10(least));
    panel.least -= std::max(1.5, 0.15 * (panel.worst - panel.least)); // room for names behind the last points
    panel.bottom = std::log10(bottom) - 0.2;
    panel.top = std::log10(top) + 0.2;
    return panel;
}

/// Names at the ends of the curves, where there is room for them; the leading ones come first.
std::string names_script(const std::vector<Curve>& curves, const ChartPanel& panel)
{
    std::string text;
    std::vector<std::pair<double, double>> taken;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        if (curves[k].points.empty()) continue;
        const ChartPoint& last = *curves[k].points.back();
        const auto [x, y] = panel.place(last);
        if (std::ranges::any_of(taken, [x = x, y = y](const std::pair<double, double>& other) {
                return std::abs(other.first - x) < name_width && std::abs(other.second - y) < name_height;
            }))
            continue;
        taken.emplace_back(x, y);
        text += fmt::format("set label {} at first {:g}, first {:g} left offset 0.6,0.1 font ',9' textcolor rgb '{}'\n",
                            gnuplot_text(curves[k].name), panel.shown(last), panel.y(last), colour_of(curves[k], k));
    }
    return text;
}

/// Every second or fourth decade that is shown, and the column of failures.
std::string tics_script(const ChartPanel& panel)
{
    std::string text = fmt::format("set xtics ('failed' {:g}", failures_at * panel.largest);
    const int apart = panel.worst - panel.least > 20 ? 4 : 2;
    const int first = static_cast<int>(std::floor(std::log10(panel.largest) / apart)) * apart;
    for (int k = first; k > panel.least; k -= apart)
        text += k == 0 ? std::string(", '1' 1") : fmt::format(", '1e{0}' 1e{0}", k);
    return text + ")\n";
}

/// A block of gnuplot, x and y of each point.
std::string points_block(const std::string& name, const std::vector<const ChartPoint*>& points, const ChartPanel& panel)
{
    std::string text = fmt::format("${} << LAGEN_END\n", name);
    for (const ChartPoint* point : points) text += fmt::format("{:.6g} {:.6g}\n", panel.shown(*point), panel.y(*point));
    return text + "LAGEN_END\n";
}

std::string panel_script(const std::vector<Curve>& curves, const ChartPanel& panel, bool legend)
{
    std::string text, plots;
    for (std::size_t k = curves.size(); k-- > 0;) { // leading ones on top of the others
        if (!curves[k].points.empty()) {
            text += points_block(fmt::format("curve{}", k), curves[k].points, panel);
            plots += fmt::format("$curve{} {} notitle, \\\n     ", k, style_of(curves[k], k));
        }
        if (!curves[k].failures.empty()) {
            text += points_block(fmt::format("failed{}", k), curves[k].failures, panel);
            plots +=
                fmt::format("$failed{} with points linecolor rgb '{}' pointtype 2 pointsize 0.8 notitle, \\\n     ", k,
                            colour_of(curves[k], k));
        }
    }
    text += fmt::format("unset label\n{}{}set xlabel {}\nset ylabel {}\n{}\nset xrange [{:g}:{:g}]\nset yrange "
                        "[{:g}:{:g}]\nplot {}",
                        names_script(curves, panel), tics_script(panel), gnuplot_text(panel.x_label),
                        gnuplot_text(panel.y_label), legend ? "set key" : "unset key", std::pow(10, panel.worst),
                        std::pow(10, panel.least), std::pow(10, panel.bottom), std::pow(10, panel.top), plots);
    // The key tells leading methods and peers; others bear their names at their ends, where there is room.
    for (std::size_t k = 0; k < curves.size(); ++k)
        if (curves[k].leads || curves[k].peer)
            text += fmt::format("NaN {} title {}, \\\n     ", style_of(curves[k], k), gnuplot_text(curves[k].name));
    text += fmt::format("NaN with lines linecolor rgb '{}' linewidth 1 title 'other methods'", quiet_colours[0]);
    return text + "\n";
}

std::string title_of(const Chart& chart)
{
    return fmt::format("{}, scene {}, t = {:.6g} to {:.6g}, {} form; reference: {} and {} in 113 bits, {:.0e} apart",
                       chart.title.empty() ? chart.model : chart.title, chart.scene, chart.start, chart.end, chart.form,
                       chart.reference_methods[0], chart.reference_methods[1], chart.reference_error);
}

/// Panels in rows of two.
std::string picture_script(const Chart& chart, const std::vector<std::string>& leading,
                           const std::vector<ChartPanel>& panels, const std::string& picture)
{
    const std::vector<Curve> curves = curves_of(chart, leading);
    const int columns = panels.size() > 1 ? 2 : 1, rows = (static_cast<int>(panels.size()) + 1) / 2;
    const double margin = 0.1 / rows;
    std::string script =
        gnuplot_terminal(picture_extension(picture), chart_width, rows * chart_height) +
        fmt::format("set output {}\nset multiplot layout {},{} margins 0.068,0.845,{},{} spacing 0.095,{} title {}\n"
                    "set key at screen 0.853,{} left top Left reverse samplen 3 spacing 0.92 font ',10'\n",
                    gnuplot_text(picture), rows, columns, margin, 1 - margin, 2 * margin, gnuplot_text(title_of(chart)),
                    1 - 0.08 / rows) +
        "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.7 dashtype 1\n"
        "set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\nset logscale xy\n"
        "set format y '%.0e'\n";
    for (std::size_t k = 0; k < panels.size(); ++k)
        script += panel_script(curves, fitted(chart, panels[k]), k + 1 == panels.size());
    return script + "unset multiplot\nunset output\n";
}

/// Methods that are the cheapest for some x of `first` or less, or take at most so many times as long as that.
std::vector<std::string> leading_in(const Chart& chart, const Measure& x, double first, double last, double times)
{
    std::vector<std::pair<double, double>> allowed; // x and seconds
    for (double level = first; level > last; level *= 0.31622776601683794) {
        double best = HUGE_VAL;
        for (const ChartPoint& point : chart.points)
            if (point.error && x(point) <= level) best = std::min(best, point.seconds);
        allowed.emplace_back(level, times * best);
    }
    std::vector<std::string> leading;
    for (const std::string& name : charted_methods(chart))
        if (std::ranges::any_of(chart.points, [&](const ChartPoint& point) {
                return name_of(point) == name && point.error &&
                       std::ranges::any_of(allowed, [&](const std::pair<double, double>& most) {
                           return x(point) <= most.first && point.seconds <= most.second;
                       });
            }))
            leading.push_back(name);
    return leading;
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
    return distinct(chart.points, name_of);
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
    std::string text = fmt::format("{}, scene {}, {} form, {} from t = {:.9g} to {:.9g}\n", chart.model, chart.scene,
                                   chart.form, count_text(chart.times.size(), "sample"), chart.start, chart.end);
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

std::vector<std::string> leading_methods(const Chart& chart, double times)
{
    return leading_in(chart, error_shown, 1e-2, 1e-15, times);
}

void draw_chart(const Chart& chart, const std::string& path)
{
    const std::string label = "error of the state, largest over the samples";
    draw_picture(path, [&](const std::string& picture) {
        return picture_script(chart, leading_methods(chart, near_the_best),
                              {{label, "seconds", error_shown, seconds_shown},
                               {label, "calls of the right-hand side", error_shown, calls_shown}},
                              picture);
    });
}

bool draw_drifts(const Chart& chart, const std::string& path)
{
    std::vector<ChartPanel> panels;
    std::vector<std::string> leading = leading_methods(chart, near_the_best); // in the colours of the chart
    for (const std::string& name : charted_invariants(chart)) {
        if (panels.size() == most_invariants) break;
        const Measure drift = drift_shown(name);
        const double largest = largest_drift(chart, drift);
        panels.push_back(
            {fmt::format("drift of {}, largest over the steps", name), "seconds", drift, seconds_shown, largest});
        for (std::string& method : leading_in(chart, drift, 1e-3 * largest, 1e-15, near_the_best))
            if (std::ranges::find(leading, method) == leading.end()) leading.push_back(std::move(method));
    }
    if (panels.empty()) return false;
    draw_picture(path, [&](const std::string& picture) { return picture_script(chart, leading, panels, picture); });
    return true;
}

} // namespace lagen
