// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/page.hpp"

#include "commands/machine/gnuplot.hpp"
#include "commands/plot/labels.hpp"
#include "commands/plot/thinned.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lagen {

namespace {

// Pixels.
constexpr int broad_page = 900, narrow_page = 640; ///< pages with and without functions of time
constexpr int top_margin = 44, left_margin = 100, right_margin = 28;
constexpr int series_height = 244, plane_height = 440,
              space_height = 540; ///< panels over t, of two coordinates, in space
constexpr int least_equal = 200, most_equal = 620;
constexpr int gap = 26, gap_with_axis = 70, gap_of_space = 40;
constexpr int label_middle = 18; ///< of labels of ordinates, from the left
constexpr int legend_line = 20, legend_sample = 34, legend_key = 56, longest_legend = 300;

/// Where the legend of a panel stands: beside it in one column where that has room, else below it in as many columns as
/// have.
struct LegendPlace {
    bool beside = true;
    int left = 0, top = 0;  ///< of the first entry
    int rows = 0, text = 0; ///< entries below one another, and the pixels that a text has
};

/// A panel with its place on the page.
struct Place {
    int top = 0, height = 0, below = 0;
    bool abscissa = true; ///< numbers and a label below it
    LegendPlace legend;
};

struct Page {
    int width = 0, height = 0, panel_width = 0;
    std::vector<Place> places;
};

double range_of(double extent, double around)
{
    return extent > 1e-12 * std::fabs(around) ? extent : around == 0 ? 1 : std::fabs(around);
}

/// What is drawn, with marks room for their texts.
Box box_of(const Drawing& drawing, int width, int height)
{
    Box box = empty_box();
    for (const Stroke& stroke : drawing.strokes) extend(box, stroke.lines);
    const double units = std::max(box.width() / width, box.height() / height);
    for (const Mark& mark : drawing.marks) {
        const double length = units * text_width(mark.text), half = 9 * units;
        const double begin = mark.at.x - length * (mark.align == Align::left     ? 0
                                                   : mark.align == Align::centre ? 0.5
                                                                                 : 1);
        extend(box, {{{begin, mark.at.y - half}, {begin + length, mark.at.y + half}}});
    }
    return box;
}

/// The height of a panel with one scale on both axes follows from what is in it.
int height_of(const Drawing& drawing, int width)
{
    if (drawing.over_time) return series_height;
    if (!drawing.equal) return plane_height;
    const Box box = drawing.frame ? drawing.box : box_of(drawing, width, space_height);
    const double most = drawing.frame ? most_equal : space_height;
    const double x = range_of(box.width(), box.high.x), y = range_of(box.height(), box.high.y);
    return static_cast<int>(std::clamp(width * y / x, double{least_equal}, most));
}

/// The smallest that `height_of` may be.
int least_height(const Drawing& drawing)
{
    return drawing.over_time ? series_height : drawing.equal ? least_equal : plane_height;
}

int widest_legend(const Drawing& drawing)
{
    int widest = 0;
    for (const auto& [style, text] : drawing.legend) widest = std::max(widest, text_width(text));
    return widest;
}

bool has_legend_beside(const Drawing& drawing)
{
    return widest_legend(drawing) <= longest_legend &&
           static_cast<int>(drawing.legend.size()) * legend_line <= least_height(drawing);
}

/// Pixels for the broadest legend beside the panels.
int legend_width(const std::vector<Drawing>& panels)
{
    int widest = 0;
    for (const Drawing& drawing : panels)
        if (has_legend_beside(drawing)) widest = std::max(widest, widest_legend(drawing));
    return widest == 0 ? right_margin : widest + legend_key;
}

/// Of a panel from `top` to `bottom`, its axis included.
LegendPlace legend_place(const Drawing& drawing, int top, int bottom, int panel_width)
{
    const int count = static_cast<int>(drawing.legend.size());
    if (has_legend_beside(drawing)) return {true, left_margin + panel_width + 12, top, count, longest_legend};
    const int text = std::min(widest_legend(drawing), panel_width - legend_key);
    const int columns = panel_width / (text + legend_key);
    return {false, left_margin, bottom, (count + columns - 1) / columns, text};
}

Page page_of(const std::vector<Drawing>& panels)
{
    Page page;
    const bool over_time = std::ranges::any_of(panels, &Drawing::over_time);
    const int legend = legend_width(panels);
    page.width = over_time ? broad_page : narrow_page + legend - right_margin;
    page.panel_width = page.width - left_margin - legend;
    int top = top_margin;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const bool shared = k + 1 < panels.size() && panels[k].over_time && panels[k + 1].over_time;
        const bool bare = !panels[k].frame && panels[k].x_label.empty();
        const int height = height_of(panels[k], page.panel_width);
        int below = shared || bare ? gap : panels[k].frame ? gap_with_axis : gap_of_space;
        const LegendPlace place = legend_place(panels[k], top, top + height + below, page.panel_width);
        if (!place.beside) below += place.rows * legend_line + gap / 2;
        page.places.push_back({top, height, below, !shared, place});
        top += height + below;
    }
    page.height = top;
    return page;
}

/// The ranges that give both axes one scale, the data in the middle.
Box equal_box(const Box& data, int width, int height)
{
    constexpr double margin = 1.08;
    const double x = range_of(data.width(), data.high.x), y = range_of(data.height(), data.high.y);
    const double units = margin * std::max(x / width, y / height);
    const Point middle{(data.low.x + data.high.x) / 2, (data.low.y + data.high.y) / 2};
    return {{middle.x - units * width / 2, middle.y - units * height / 2},
            {middle.x + units * width / 2, middle.y + units * height / 2}};
}

const char* name_of(Align align)
{
    return align == Align::left ? "left" : align == Align::centre ? "center" : "right";
}

std::string range_text(const char* axis, double from, double to)
{
    return fmt::format("set {}range [{}:{}]\n", axis, from, to);
}

/// Ranges, and the pixels for a unit that they make.
std::string ranges_of(const Drawing& drawing, int width, int height, Scale& scale)
{
    Box box = drawing.frame ? drawing.box : box_of(drawing, width, height);
    std::string text = "set autoscale\n";
    if (drawing.equal) {
        box = equal_box(box, width, height);
        text = range_text("x", box.low.x, box.high.x) + range_text("y", box.low.y, box.high.y);
    } else if (drawing.over_time) {
        text = "set autoscale y\n" + (box.width() > 0 ? range_text("x", box.low.x, box.high.x) : "set autoscale x\n");
    }
    scale = {width / range_of(box.width(), box.high.x), height / range_of(box.height(), box.high.y)};
    return text;
}

std::string frame_text(const Drawing& drawing, const Place& place, int page_width)
{
    std::string text = "unset label\n";
    if (drawing.frame)
        text +=
            "set border 3 linecolor rgb '#444444'\nset xtics nomirror out scale 0.6\nset ytics nomirror out scale 0.6\n"
            "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.8 dashtype 1\n";
    else
        text += "unset border\nunset xtics\nunset ytics\nunset grid\n";
    text += fmt::format("set format x '{}'\n", place.abscissa ? "%g" : "");
    text += fmt::format("set label {} at screen {:.5f}, graph 0.5 center rotate by 90\n", gnuplot_text(drawing.y_label),
                        static_cast<double>(label_middle) / page_width);
    text += place.abscissa ? fmt::format("set xlabel {}{}\n", gnuplot_text(drawing.x_label),
                                         drawing.frame ? " offset 0,0" : " offset 0,0.8")
                           : "unset xlabel\n";
    for (const Mark& mark : drawing.marks)
        text += fmt::format("set label {} at {},{} {} front\n", gnuplot_text(mark.text), mark.at.x, mark.at.y,
                            name_of(mark.align));
    return text;
}

/// A block of gnuplot's data for each stroke; `plots` gains what draws them.
std::string strokes_text(const Drawing& drawing, const Scale& scale, std::vector<std::string>& plots)
{
    std::string text;
    for (std::size_t k = 0; k < drawing.strokes.size(); ++k) {
        const Stroke& stroke = drawing.strokes[k];
        std::string data;
        for (const Polyline& line : stroke.lines) {
            for (const Point& point : stroke.points ? distinct(line, scale) : thinned(line, scale))
                data += fmt::format("{} {}\n", point.x, point.y);
            data += "\n";
        }
        if (data.find_first_not_of('\n') == std::string::npos) continue;
        text += fmt::format("$stroke{} << LAGEN_END\n{}LAGEN_END\n", k, data);
        plots.push_back(fmt::format("$stroke{} using 1:2 with {} notitle", k, stroke.style));
    }
    return text;
}

/// A sample of each curve with its name, of which the end is cut where it is broader than the page.
std::string legend_text(const Drawing& drawing, const LegendPlace& place, const Page& page)
{
    const auto screen = [&](int x, int y) {
        return fmt::format("screen {:.5f},{:.5f}", static_cast<double>(x) / page.width,
                           1 - static_cast<double>(y) / page.height);
    };
    std::string text = "unset arrow\n";
    for (int k = 0; k < static_cast<int>(drawing.legend.size()); ++k) {
        const auto& [style, name] = drawing.legend[static_cast<std::size_t>(k)];
        const int x = place.left + k / place.rows * (place.text + legend_key);
        const int y = place.top + legend_line / 2 + k % place.rows * legend_line;
        const auto [kind, look] = std::pair(style.substr(0, style.find(' ')), style.substr(style.find(' ')));
        text += kind == "points" ? fmt::format("set label '' at {} point{}\n", screen(x + legend_sample / 2, y), look)
                                 : fmt::format("set arrow from {} to {} nohead{}\n", screen(x, y),
                                               screen(x + legend_sample, y), look);
        text += fmt::format("set label {} at {} left\n", gnuplot_text(shortened(name, place.text)),
                            screen(x + legend_sample + 8, y));
    }
    return text;
}

std::string panel_text(const Drawing& drawing, const Place& place, const Page& page)
{
    const auto from_top = [&](int pixels) { return 1 - static_cast<double>(pixels) / page.height; };
    std::string text = fmt::format("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n", from_top(place.top),
                                   from_top(place.top + place.height));
    Scale scale;
    text += frame_text(drawing, place, page.width) + ranges_of(drawing, page.panel_width, place.height, scale);
    text += legend_text(drawing, place.legend, page);
    std::vector<std::string> plots;
    text += strokes_text(drawing, scale, plots);
    if (plots.empty()) plots.emplace_back("NaN notitle");
    std::string list;
    for (const std::string& plot : plots) list += (list.empty() ? "plot " : ", \\\n     ") + plot;
    return text + list + "\n";
}

std::string script_of(const std::vector<Drawing>& panels, const std::string& title, const std::string& extension,
                      const std::string& picture)
{
    const Page page = page_of(panels);
    std::string script = gnuplot_terminal(extension, page.width, page.height);
    script += fmt::format("set output {}\nset multiplot title {}\n", gnuplot_text(picture),
                          gnuplot_text(shortened(title, page.width - 40)));
    script += fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n",
                          static_cast<double>(left_margin) / page.width,
                          static_cast<double>(left_margin + page.panel_width) / page.width);
    for (std::size_t k = 0; k < panels.size(); ++k) script += panel_text(panels[k], page.places[k], page);
    return script + "unset multiplot\nunset output\n";
}

} // namespace

void draw_page(const std::vector<Drawing>& panels, const std::string& title, const std::string& path)
{
    draw_picture(
        path, [&](const std::string& picture) { return script_of(panels, title, picture_extension(path), picture); });
}

} // namespace lagen
