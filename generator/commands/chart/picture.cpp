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
constexpr double chart_left = 0.06, chart_right = 0.86, chart_middle = 0.045, chart_top = 0.885, chart_bottom = 0.1;

constexpr double largest_error = 10;   ///< of the picture
constexpr double failure_column = 100; ///< where failures are drawn
constexpr double near_the_best = 1.3;  ///< times the cheapest: a method that leads

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
    std::ranges::stable_partition(curves, [](const Curve& curve) { return curve.leads; });
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

std::string style_of(const Curve& curve, std::size_t k)
{
    constexpr std::size_t shapes[] = {7, 5, 9, 11, 13, 4, 6, 8, 10, 12};
    if (curve.leads)
        return fmt::format("linecolor rgb '{}' linewidth 2.4 pointtype {} pointsize 0.55 dashtype {}",
                           picture_colours[k % picture_colours.size()], shapes[k % std::size(shapes)],
                           k / picture_colours.size() + 1);
    return fmt::format("linecolor rgb '{}' linewidth 1 pointtype {} pointsize 0.5 dashtype {}",
                       k % 3 == 0   ? "#8a8a8a"
                       : k % 3 == 1 ? "#a9a08c"
                                    : "#8c9aa9",
                       shapes[k % std::size(shapes)], 2 + k % 4);
}

/// The panel with `column` of the blocks over the error.
std::string panel_script(const std::vector<Curve>& curves, int column, const char* label, bool legend)
{
    std::string text = fmt::format("set ylabel '{}'\n{}\nplot ", label, legend ? "set key" : "unset key");
    const char* separator = "";
    for (std::size_t k = curves.size(); k-- > 0;) { // leading ones on top of the others
        const std::string style = style_of(curves[k], k);
        if (!curves[k].points.empty())
            text += fmt::format("{}$curve{} using 1:{} with linespoints {} notitle", separator, k, column, style);
        else
            text += fmt::format("{}NaN notitle", separator);
        separator = ", \\\n     ";
        if (!curves[k].failures.empty())
            text += fmt::format("{}$failed{} using 1:{} with points linecolor rgb '{}' pointtype 2 pointsize 0.8 "
                                "notitle",
                                separator, k, column,
                                curves[k].leads ? picture_colours[k % picture_colours.size()] : "#8a8a8a");
    }
    for (std::size_t k = 0; k < curves.size(); ++k)
        text += fmt::format("{}NaN with linespoints {} title {}", separator, style_of(curves[k], k),
                            gnuplot_text(curves[k].name));
    return text + "\n";
}

double least_error(const Chart& chart)
{
    double least = 1e-3;
    for (const ChartPoint& point : chart.points)
        if (point.error) least = std::min(least, shown_error(point));
    return std::pow(10, std::floor(std::log10(least)));
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
    const double panel = (chart_right - chart_left - chart_middle) / 2 - 0.01;
    std::string script = gnuplot_terminal(picture_extension(picture), chart_width, chart_height);
    script += fmt::format("set output {}\n", gnuplot_text(picture));
    bool failed = false;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        script += points_block(fmt::format("curve{}", k), curves[k].points);
        if (curves[k].failures.empty()) continue;
        failed = true;
        script += points_block(fmt::format("failed{}", k), curves[k].failures);
    }
    script += fmt::format("set multiplot title {}\n", gnuplot_text(title_of(chart)));
    script += fmt::format("set tmargin at screen {}\nset bmargin at screen {}\n", chart_top, chart_bottom);
    script += fmt::format("set key at screen {}, screen {} left top Left reverse samplen 3 spacing 0.92 font ',10'\n",
                          chart_right + 0.008, chart_top + 0.02);
    script += "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.7 dashtype 1\n"
              "set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\nset logscale xy\n"
              "set format y '%.0e'\nset xlabel 'error of the state, largest over the samples'\n"
              "set ylabel offset 1,0\n";
    script += fmt::format("set xrange [{:g}:{:g}]\n", failed ? 3 * failure_column : largest_error, least_error(chart));
    script += "set xtics ('10' 10, '1e-2' 1e-2, '1e-4' 1e-4, '1e-6' 1e-6, '1e-8' 1e-8, '1e-10' 1e-10, '1e-12' 1e-12, "
              "'1e-14' 1e-14, '1e-16' 1e-16";
    script += failed ? fmt::format(", 'failed' {:g})\n", failure_column) : ")\n";
    const double second = chart_left + panel + chart_middle + 0.02;
    script +=
        fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n", chart_left, chart_left + panel) +
        panel_script(curves, 2, "seconds", false);
    script += fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n", second, second + panel) +
              panel_script(curves, 3, "calls of the right-hand side", true);
    return script + "unset multiplot\nunset output\n";
}

} // namespace

std::vector<std::string> leading_methods(const Chart& chart, double times)
{
    std::vector<std::string> leading;
    for (double error = 1e-1; error > 1e-15; error *= 0.31622776601683794) {
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
