// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/picture.hpp"

#include "commands/chart/report.hpp"
#include "commands/gnuplot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

// Pixels, and what they are fractions of.
constexpr int chart_width = 1240, chart_height = 600;
constexpr double chart_left = 0.068, chart_right = 0.865, chart_middle = 0.095, chart_top = 0.9, chart_bottom = 0.1;
constexpr double panel_width = (chart_right - chart_left - chart_middle) / 2;
constexpr double label_width = 78, label_height = 11;

constexpr double largest_error = 10;   ///< of the picture
constexpr double failure_column = 300; ///< where failures are drawn
constexpr double near_the_best = 1.1;  ///< times the cheapest: a method that leads

struct Curve {
    std::string name;
    std::vector<const ChartPoint*> points; ///< with errors, the largest first
    std::vector<const ChartPoint*> failures;
    bool leads = false;
};

/// Leading methods first.
std::vector<Curve> curves_of(const Chart& chart)
{
    const std::vector<std::string> leading = leading_methods(chart, near_the_best);
    std::vector<Curve> curves;
    for (const std::string& name : charted_methods(chart)) {
        Curve curve{name, {}, {}, std::ranges::find(leading, name) != leading.end()};
        for (const ChartPoint& point : chart.points)
            if (name_of(point) == name) (point.error ? curve.points : curve.failures).push_back(&point);
        curves.push_back(std::move(curve));
    }
    std::stable_partition(curves.begin(), curves.end(), [](const Curve& curve) { return curve.leads; });
    return curves;
}

double shown_error(const ChartPoint& point)
{
    return std::clamp(*point.error, 1e-17, largest_error);
}

/// A block of gnuplot: error, seconds and calls of each point.
std::string points_block(const std::string& name, const std::vector<const ChartPoint*>& points)
{
    std::string text = fmt::format("${} << LAGEN_END\n", name);
    for (const ChartPoint* point : points)
        text += fmt::format("{:.6g} {:.6g} {}\n", point->error ? shown_error(*point) : failure_column, point->seconds,
                            std::max<std::size_t>(point->rhs_calls, 1));
    return text + "LAGEN_END\n";
}

/// Colours of curves that do not lead.
constexpr const char* quiet_colours[] = {"#9a9a9a", "#b3a17c", "#8fa3bf"};

const char* colour_of(const Curve& curve, std::size_t k)
{
    return curve.leads ? picture_colours[k % picture_colours.size()] : quiet_colours[k % std::size(quiet_colours)];
}

std::string style_of(const Curve& curve, std::size_t k)
{
    constexpr std::size_t shapes[] = {7, 5, 9, 11, 13, 4, 6, 8, 10, 12};
    return fmt::format("linecolor rgb '{}' linewidth {} pointtype {} pointsize {} dashtype {}", colour_of(curve, k),
                       curve.leads ? 2.4 : 1, shapes[k % std::size(shapes)], curve.leads ? 0.55 : 0.45,
                       curve.leads ? k / picture_colours.size() + 1 : 1);
}

/// A panel: what is charted over the error, and the decades of both axes.
struct ChartPanel {
    int column = 2; ///< of the blocks
    const char* label = "";
    double (*value)(const ChartPoint&) = nullptr;
    double worst = 0, least = 0, bottom = 0, top = 0; ///< log10

    [[nodiscard]] std::pair<double, double> pixels(const ChartPoint& point) const
    {
        return {(worst - std::log10(shown_error(point))) / (worst - least) * panel_width * chart_width,
                (std::log10(value(point)) - bottom) / (top - bottom) * (chart_top - chart_bottom) * chart_height};
    }
};

double seconds_shown(const ChartPoint& point)
{
    return point.seconds;
}

double calls_shown(const ChartPoint& point)
{
    return static_cast<double>(std::max<std::size_t>(point.rhs_calls, 1));
}

ChartPanel panel_of(const Chart& chart, int column, const char* label, double (*value)(const ChartPoint&))
{
    double least = 1e-3, bottom = HUGE_VAL, top = 0;
    bool failed = false;
    for (const ChartPoint& point : chart.points) {
        failed = failed || !point.error;
        if (point.error) least = std::min(least, shown_error(point));
        bottom = std::min(bottom, value(point));
        top = std::max(top, value(point));
    }
    // Room for names behind the last points.
    return {column,
            label,
            value,
            std::log10(failed ? 7 * failure_column : largest_error),
            std::floor(std::log10(least)) - 1.5,
            std::log10(bottom) - 0.2,
            std::log10(top) + 0.2};
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
        text +=
            fmt::format("set label {} at first {:g}, first {:g} left offset 0.6,0.1 font ',9' textcolor rgb '{}'\n",
                        gnuplot_text(curves[k].name), shown_error(last), panel.value(last), colour_of(curves[k], k));
    }
    return text;
}

std::string panel_script(const std::vector<Curve>& curves, const ChartPanel& panel, bool legend)
{
    std::string text = fmt::format("unset label\n{}set ylabel '{}'\n{}\nset xrange [{:g}:{:g}]\nset yrange "
                                   "[{:g}:{:g}]\nplot ",
                                   names_script(curves, panel), panel.label, legend ? "set key" : "unset key",
                                   std::pow(10, panel.worst), std::pow(10, panel.least), std::pow(10, panel.bottom),
                                   std::pow(10, panel.top));
    for (std::size_t k = curves.size(); k-- > 0;) { // leading ones on top of the others
        if (!curves[k].points.empty())
            text += fmt::format("$curve{} using 1:{} with linespoints {} notitle, \\\n     ", k, panel.column,
                                style_of(curves[k], k));
        if (!curves[k].failures.empty())
            text += fmt::format("$failed{} using 1:{} with points linecolor rgb '{}' pointtype 2 pointsize 0.8 "
                                "notitle, \\\n     ",
                                k, panel.column, colour_of(curves[k], k));
    }
    for (std::size_t k = 0; k < curves.size(); ++k)
        text += fmt::format("{}NaN with linespoints {} title {}", k == 0 ? "" : ", \\\n     ", style_of(curves[k], k),
                            gnuplot_text(curves[k].name));
    return text + "\n";
}

std::string title_of(const Chart& chart)
{
    return fmt::format("{}, scene {}, t = {:.6g} to {:.6g}, {} form; reference: {} and {} in 113 bits, {:.0e} apart",
                       chart.title.empty() ? chart.model : chart.title, chart.scene, chart.start, chart.end, chart.form,
                       chart.reference_methods[0], chart.reference_methods[1], chart.reference_error);
}

std::string chart_script(const Chart& chart, const std::string& picture)
{
    const std::vector<Curve> curves = curves_of(chart);
    std::string script = gnuplot_terminal(picture_extension(picture), chart_width, chart_height);
    script += fmt::format("set output {}\n", gnuplot_text(picture));
    for (std::size_t k = 0; k < curves.size(); ++k) {
        if (!curves[k].points.empty()) script += points_block(fmt::format("curve{}", k), curves[k].points);
        if (!curves[k].failures.empty()) script += points_block(fmt::format("failed{}", k), curves[k].failures);
    }
    script += fmt::format("set multiplot title {}\n", gnuplot_text(title_of(chart)));
    script += fmt::format("set tmargin at screen {}\nset bmargin at screen {}\n", chart_top, chart_bottom);
    script += fmt::format("set key at screen {}, screen {} left top Left reverse samplen 3 spacing 0.92 font ',10'\n",
                          chart_right + 0.008, chart_top + 0.02);
    script += "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.7 dashtype 1\n"
              "set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\nset logscale xy\n"
              "set format y '%.0e'\nset xlabel 'error of the state, largest over the samples'\n"
              "set ylabel offset -0.3,0\nset xtics ('1' 1";
    for (int k = 2; k <= 16; k += 2) script += fmt::format(", '1e-{0}' 1e-{0}", k);
    script += fmt::format(", 'failed' {:g})\n", failure_column);
    const ChartPanel panels[] = {panel_of(chart, 2, "seconds", seconds_shown),
                                 panel_of(chart, 3, "calls of the right-hand side", calls_shown)};
    for (const std::size_t k : {0U, 1U}) {
        const double left = chart_left + static_cast<double>(k) * (panel_width + chart_middle);
        script +=
            fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n", left, left + panel_width) +
            panel_script(curves, panels[k], k == 1);
    }
    return script + "unset multiplot\nunset output\n";
}

} // namespace

std::vector<std::string> leading_methods(const Chart& chart, double times)
{
    std::vector<std::string> leading;
    for (double error = 1e-2; error > 1e-15; error *= 0.31622776601683794) {
        const ChartPoint* best = cheapest_within(chart.points, error);
        if (best == nullptr) break;
        for (const ChartPoint& point : chart.points)
            if (point.error && *point.error <= error && point.seconds <= times * best->seconds &&
                std::ranges::find(leading, name_of(point)) == leading.end())
                leading.push_back(name_of(point));
    }
    return leading;
}

void draw_chart(const Chart& chart, const std::string& path)
{
    draw_picture(path, [&](const std::string& picture) { return chart_script(chart, picture); });
}

} // namespace lagen
