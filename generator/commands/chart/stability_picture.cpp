// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/stability_chart.hpp"
#include "commands/machine/gnuplot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

// Pixels.
constexpr int picture_width = 1240, panel_height = 226, head_height = 64, foot_height = 46, row_height_alone = 26;
constexpr int most_columns = 5, panel_gap = 26, left_margin = 70, right_margin = 14, panel_title = 20;

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

/// What the black line is.
const char* limit_name(const StabilityChart& chart)
{
    const auto meets_fold = [](const ChartedMethod& method) {
        return std::ranges::any_of(method.folds, [](double fold) { return fold > 0; });
    };
    return std::ranges::any_of(chart.methods, meets_fold) ? "end of the linear interval, or a fold"
                                                          : "end of the linear interval, h omega";
}

/// A box and a name for each outcome, in a line at the top.
std::string legend_script(const StabilityChart& chart, int height)
{
    std::string text;
    const double y = 1 - 44.0 / height, half = 6.0 / height;
    double x = 0.05;
    for (std::size_t k = 0; k < outcome_table.size(); ++k) {
        text += fmt::format("set object {} rectangle from screen {:.4f}, screen {:.5f} to screen {:.4f}, screen {:.5f} "
                            "fillcolor rgb '{}' fillstyle solid noborder\n",
                            k + 1, x, y - half, x + 0.012, y + half, outcome_table[k].colour);
        text += fmt::format("set label {} {} at screen {:.4f}, screen {:.5f} left\n", k + 1,
                            gnuplot_text(outcome_table[k].name), x + 0.016, y);
        x += 0.135;
    }
    text += fmt::format("set arrow 1 from screen {0:.4f}, screen {1:.5f} to screen {2:.4f}, screen {1:.5f} nohead "
                        "linecolor rgb 'black' linewidth 1.8 front\n",
                        x, y, x + 0.02);
    text += fmt::format("set label 9 {} at screen {:.4f}, screen {:.5f} left\n", gnuplot_text(limit_name(chart)),
                        x + 0.025, y);
    text += fmt::format(
        "set label 10 {} at screen 0.5, screen {:.5f} center\n",
        gnuplot_text(fmt::format("{}, scene {}, t = {:.6g} to {:.6g}, {} form; followed: {}",
                                 chart.title.empty() ? chart.model : chart.title, chart.scene, chart.start, chart.end,
                                 chart.form, chart.followed.empty() ? "the size of the state" : chart.followed)),
        1 - 16.0 / height);
    return text;
}

std::string common_script(const StabilityChart& chart, const std::string& picture, int height)
{
    return gnuplot_terminal(picture_extension(picture), picture_width, height) +
           fmt::format("set output {}\nset multiplot\n", gnuplot_text(picture)) + legend_script(chart, height) +
           "unset key\nset border 15 linecolor rgb '#444444'\nset tics out nomirror scale 0.5 font ',10'\n"
           "set style fill solid 1 border\n";
}

std::string margins(double left, double right, double bottom, double top, int height)
{
    return fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset bmargin at screen {:.5f}\nset "
                       "tmargin at screen {:.5f}\n",
                       left / picture_width, right / picture_width, 1 - bottom / height, 1 - top / height);
}

/// 1, 2 or 5 times a power of ten: three to six tics.
double tic_of(double last)
{
    const double power = std::pow(10, std::floor(std::log10(last / 3)));
    return power * (last / 3 >= 5 * power ? 5 : last / 3 >= 2 * power ? 2 : 1);
}

constexpr const char* draw_boxes = "using 1:2:3:4:5:6:7 with boxxyerror linecolor rgb variable";

/// A panel a method, the second axis upwards.
std::string panels_script(const StabilityChart& chart, const std::string& picture)
{
    const int count = static_cast<int>(chart.methods.size()), panel_columns = std::clamp(count, 2, most_columns);
    const int rows = (count + panel_columns - 1) / panel_columns;
    const int height = head_height + rows * panel_height + foot_height;
    const double width =
        (picture_width - left_margin - right_margin - (panel_columns - 1.0) * panel_gap) / panel_columns;
    const std::vector<double>&steps = chart.axes[0].values, &values = chart.axes[1].values;
    std::string text = common_script(chart, picture, height);
    text += fmt::format("set xrange [{:.7g}:{:.7g}]\nset yrange [{:.7g}:{:.7g}]\n", cell_ends(steps, 0).first,
                        cell_ends(steps, steps.size() - 1).second, cell_ends(values, 0).first,
                        cell_ends(values, values.size() - 1).second);
    text += fmt::format("set xtics 0,{:.3g}\nset format x '%g'\n", tic_of(steps.back()));
    for (int k = 0; k < count; ++k) {
        const ChartedMethod& method = chart.methods[static_cast<std::size_t>(k)];
        const double left = left_margin + k % panel_columns * (width + panel_gap);
        const double top = head_height + static_cast<double>(k / panel_columns) * panel_height + panel_title;
        std::string boxes;
        for (std::size_t j = 0; j < values.size(); ++j) {
            const auto [low, high] = cell_ends(values, j);
            boxes += boxes_of(chart, method, j, low, high);
        }
        text += margins(left, left + width, top + panel_height - panel_title - 34, top, height);
        text += fmt::format("set title {} offset 0,-0.8 font ',11'\n", gnuplot_text(method.name));
        text += k + panel_columns >= count ? "set xlabel 'step' offset 0,0.6\n" : "unset xlabel\n";
        text += k % panel_columns == 0
                    ? fmt::format("set ylabel {} offset 0.4,0\nset format y '%g'\n", gnuplot_text(chart.axes[1].name))
                    : "unset ylabel\nset format y ''\n";
        text += block(fmt::format("boxes{}", k), boxes) + block(fmt::format("limit{}", k), limit_points(chart, method));
        const bool limited = std::ranges::any_of(method.limits, [](const auto& limit) { return limit.has_value(); });
        text += fmt::format("plot $boxes{} {}", k, draw_boxes);
        text += limited ? fmt::format(", $limit{} with lines linecolor rgb 'black' linewidth 1.8\n", k) : "\n";
        text += "unset object\nunset label\nunset arrow\n"; // the legend is drawn once
    }
    return text + "unset multiplot\nunset output\n";
}

/// A row a method.
std::string rows_script(const StabilityChart& chart, const std::string& picture)
{
    const std::size_t count = chart.methods.size();
    const int height = head_height + static_cast<int>(count) * row_height_alone + foot_height + 10;
    const std::vector<double>& steps = chart.axes[0].values;
    std::string text = common_script(chart, picture, height), boxes, limits, tics;
    for (std::size_t k = 0; k < count; ++k) {
        const double y = static_cast<double>(count - k);
        boxes += boxes_of(chart, chart.methods[k], 0, y - 0.4, y + 0.4);
        if (chart.methods[k].limits[0])
            limits +=
                fmt::format("{0:.7g} {1:.7g}\n{0:.7g} {2:.7g}\n\n", *chart.methods[k].limits[0], y - 0.48, y + 0.48);
        tics += fmt::format("{}{} {:g}", k == 0 ? "" : ", ", gnuplot_text(chart.methods[k].name), y);
    }
    text += margins(130, picture_width - right_margin, height - foot_height, head_height, height);
    text += fmt::format("set xrange [{:.7g}:{:.7g}]\nset yrange [0.4:{:g}]\nset ytics ({})\nset xlabel 'step'\n",
                        cell_ends(steps, 0).first, cell_ends(steps, steps.size() - 1).second,
                        static_cast<double>(count) + 0.6, tics);
    text += block("boxes", boxes) + block("limits", limits) + fmt::format("plot $boxes {}", draw_boxes);
    if (!limits.empty()) text += ", $limits with lines linecolor rgb 'black' linewidth 2.2";
    return text + "\nunset multiplot\nunset output\n";
}

} // namespace

void draw_stability(const StabilityChart& chart, const std::string& path)
{
    draw_picture(path, [&](const std::string& picture) {
        return chart.axes.size() > 1 ? panels_script(chart, picture) : rows_script(chart, picture);
    });
}

} // namespace lagen
