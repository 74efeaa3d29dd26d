// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/picture.hpp"

#include "commands/chart/report.hpp"
#include "commands/machine/gnuplot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace lagen {

namespace {

// Pixels, and what they are fractions of; a row of panels is as high as a picture of one row.
constexpr int chart_width = 1240, row_height = 600;
constexpr double chart_left = 0.068, chart_right = 0.845, chart_middle = 0.095, row_top = 0.1, row_bottom = 0.1;
constexpr double label_width = 78, label_height = 11;
constexpr double label_left = 68; ///< from an axis to the middle of its label, whose letters stay on the page

constexpr double largest_error = 10;       ///< of the picture
constexpr double failures_at = 30;         ///< times the largest that is shown: where failures are drawn
constexpr double near_the_best = 1.1;      ///< times the cheapest: a method that leads
constexpr std::size_t most_invariants = 4; ///< with panels of their own
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

/// What is charted over what, and the decades of both axes.
struct ChartPanel {
    std::string x_label, y_label;
    Measure x, y;                                     ///< x of points with an error
    double largest = largest_error;                   ///< x that is shown
    double worst = 0, least = 0, bottom = 0, top = 0; ///< log10
    double left = 0, width = 0;                       ///< pixels

    [[nodiscard]] double shown(const ChartPoint& point) const
    {
        return point.error ? std::clamp(x(point), least_shown, largest) : failures_at * largest;
    }
    [[nodiscard]] std::pair<double, double> pixels(const ChartPoint& point) const
    {
        return {(worst - std::log10(shown(point))) / (worst - least) * width,
                (std::log10(y(point)) - bottom) / (top - bottom) * (1 - row_top - row_bottom) * row_height};
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

/// Of the invariant `name`; what is not known or not finite counts as the worst.
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
        const auto [x, y] = panel.pixels(last);
        if (std::ranges::any_of(taken, [x = x, y = y](const std::pair<double, double>& other) {
                return std::abs(other.first - x) < label_width && std::abs(other.second - y) < label_height;
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
    text += fmt::format("unset label\n{}{}set xlabel {}\nset label {} at screen {:.5f}, graph 0.5 center rotate by 90\n"
                        "{}\nset xrange [{:g}:{:g}]\nset yrange [{:g}:{:g}]\nplot {}",
                        names_script(curves, panel), tics_script(panel), gnuplot_text(panel.x_label),
                        gnuplot_text(panel.y_label), (panel.left - label_left) / chart_width,
                        legend ? "set key" : "unset key", std::pow(10, panel.worst), std::pow(10, panel.least),
                        std::pow(10, panel.bottom), std::pow(10, panel.top), plots);
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
std::string picture_script(const Chart& chart, const std::vector<std::string>& leading, std::vector<ChartPanel> panels,
                           const std::string& picture)
{
    const std::vector<Curve> curves = curves_of(chart, leading);
    const std::size_t columns = std::min<std::size_t>(panels.size(), 2), rows = (panels.size() + 1) / 2;
    const double width =
        (chart_right - chart_left - chart_middle * static_cast<double>(columns - 1)) / static_cast<double>(columns);
    const double height = 1 / static_cast<double>(rows);
    std::string script =
        gnuplot_terminal(picture_extension(picture), chart_width, static_cast<int>(rows) * row_height) +
        fmt::format("set output {}\nset multiplot title {}\n", gnuplot_text(picture), gnuplot_text(title_of(chart))) +
        fmt::format("set key at screen {}, screen {} left top Left reverse samplen 3 spacing 0.92 font ',10'\n",
                    chart_right + 0.008, 1 - (row_top - 0.02) * height) +
        "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.7 dashtype 1\n"
        "set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\nset logscale xy\n"
        "set format y '%.0e'\n";
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const double left = chart_left + static_cast<double>(k % 2) * (width + chart_middle);
        const double top = 1 - static_cast<double>(k / 2) * height;
        panels[k].left = left * chart_width;
        panels[k].width = width * chart_width;
        script += fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen "
                              "{:.4f}\nset bmargin at screen {:.4f}\n",
                              left, left + width, top - row_top * height, top - (1 - row_bottom) * height) +
                  panel_script(curves, fitted(chart, panels[k]), k + 1 == panels.size());
    }
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
