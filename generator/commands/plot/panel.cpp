// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/panel.hpp"

#include "machine/gnuplot.hpp"
#include "text/alphabet.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace lagen {

namespace {

// Pixels.
constexpr int broad_page = 900, narrow_page = 640, title_height = 36; ///< pages with and without functions of time
constexpr int series_height = 224, plane_height = 420, space_height = 520, least_equal = 200, most_equal = 620;
constexpr int beside_panel = 140, axis_height = 56, bare_height = 24, legend_height = 18;

constexpr const char* plane_look = "set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\n"
                                   "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.8 dashtype 1\n"
                                   "set lmargin 13\nset rmargin 4\n";
constexpr const char* space_look = "unset grid\nset lmargin 2\nset rmargin 2\n";
constexpr const char* shadow_style = "lines linecolor rgb '#d0d0d0' linewidth 1 dashtype 1";
constexpr const char* grid_style = "lines linecolor rgb '#d4d4d4' linewidth 0.7 dashtype 1";

bool is_finite(const PlotPoint& point)
{
    return std::ranges::all_of(point, [](double each) { return std::isfinite(each); });
}

double length(const PlotPoint& point)
{
    return std::hypot(point[0], point[1], point[2]);
}

/// The distance of p from the segment between a and b.
double distance(const PlotPoint& p, const PlotPoint& a, const PlotPoint& b)
{
    double square = 0, along = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        square += (b[i] - a[i]) * (b[i] - a[i]);
        along += (p[i] - a[i]) * (b[i] - a[i]);
    }
    along = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
    return std::hypot(p[0] - a[0] - along * (b[0] - a[0]), p[1] - a[1] - along * (b[1] - a[1]),
                      p[2] - a[2] - along * (b[2] - a[2]));
}

/// Marks what is kept between the ends of a stretch.
void keep_between(const SampledCurve& line, std::size_t first, std::size_t last, double seen, std::vector<bool>& kept)
{
    std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        double farthest = seen;
        std::size_t at = from;
        for (std::size_t k = from + 1; k < to; ++k)
            if (const double far = distance(line[k], line[from], line[to]); far > farthest) {
                farthest = far;
                at = k;
            }
        if (at == from) continue;
        kept[at] = true;
        open.emplace_back(from, at);
        open.emplace_back(at, to);
    }
}

/// True for the points of a piece that are drawn; `line` is the piece in units of the box.
std::vector<bool> seen_points(const SampledCurve& line, Pen pen)
{
    constexpr double seen = 1.0 / 4000, seen_of_marks = 1.0 / 400; // marks are broader than lines
    constexpr std::size_t stretch = 500; // points at a time: a turbulent curve costs their square at most
    if (pen == Pen::steps) return std::vector<bool>(line.size(), true);
    std::vector<bool> kept(line.size(), false);
    if (pen == Pen::points) {
        std::set<PlotPoint> cells;
        for (std::size_t k = 0; k < line.size(); ++k) {
            PlotPoint cell = line[k];
            for (double& each : cell) each = std::round(each / seen_of_marks);
            kept[k] = cells.insert(cell).second;
        }
        return kept;
    }
    kept.front() = kept.back() = true;
    for (std::size_t first = 0; first + 1 < line.size(); first += stretch) {
        const std::size_t last = std::min(first + stretch, line.size() - 1);
        kept[last] = true;
        keep_between(line, first, last, seen, kept);
    }
    return kept;
}

/// A motion that does not move is a point; the points of many steps over time would hide one another.
Pen pen_of(const SampledCurve& curve, const Panel& panel)
{
    constexpr std::size_t many = 1000;
    if (curve.size() == 1) return Pen::points;
    return panel.pen == Pen::steps && panel.over_time && curve.size() > many ? Pen::line : panel.pen;
}

/// The direction of the eye, in degrees.
struct View {
    double azimuth = 35, elevation = 25;

    /// Positive for what is on the side of the eye.
    [[nodiscard]] double depth(const PlotPoint& point) const
    {
        const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
        return std::cos(e) * (std::cos(a) * point[0] + std::sin(a) * point[1]) + std::sin(e) * point[2];
    }
    [[nodiscard]] std::string script(double zoom) const
    {
        return fmt::format("set view {},{},{}\n", 90 - elevation, std::fmod(azimuth + 90, 360), zoom);
    }
};

/// The octant from which most of the curves is seen; the first one where it will do.
View view_of(const std::vector<SampledCurve>& curves)
{
    PlotPoint mean{};
    for (const SampledCurve& curve : curves)
        for (const PlotPoint& point : curve)
            for (std::size_t i = 0; i < 3 && is_finite(point); ++i) mean[i] += point[i];
    View best;
    if (best.depth(mean) >= 0) return best;
    for (const double up : {25.0, -25.0})
        for (const double turn : {125.0, 215.0, 305.0, 35.0})
            if (const View other{turn, up}; other.depth(mean) > best.depth(mean)) best = other;
    return best;
}

/// The radius of the sphere that is drawn; 0: none is.
double sphere_radius(const Panel& panel)
{
    constexpr double same_distance = 1e-3; // relative: less than can be seen
    double least = HUGE_VAL, most = 0;
    for (const SampledCurve& curve : panel.curves)
        for (const PlotPoint& point : curve)
            if (is_finite(point)) {
                least = std::min(least, length(point));
                most = std::max(most, length(point));
            }
    return panel.sphere.value_or(most - least <= same_distance * most) ? most : 0;
}

/// The column of colours of a point on a sphere: its curve's, two thirds of the way to white on the back.
std::string colour_at(std::size_t k, bool behind)
{
    const std::string colour = picture_colours[k % picture_colours.size()];
    if (!behind) return " 0x" + colour.substr(1);
    std::string pale = " 0x";
    for (const std::size_t at : {1U, 3U, 5U})
        pale += fmt::format("{:02x}", 255 - (255 - std::stol(colour.substr(at, 2), nullptr, 16)) / 3);
    return pale;
}

std::string range_script(char axis, double low, double high)
{
    return fmt::format("set {}range [{}:{}]\n", axis, low, high);
}

/// Writes a panel: settings, data blocks, and the parts of one command.
class PanelScript {
  public:
    explicit PanelScript(const Panel& panel)
        : panel_(panel), box_(box_of(panel.curves)), in_space_(panel.labels.size() > 2)
    {
    }

    [[nodiscard]] std::string text(bool abscissa)
    {
        if (in_space_) radius_ = sphere_radius(panel_);
        if (!in_space_)
            set_plane(abscissa);
        else if (radius_ > 0)
            set_sphere();
        else
            set_room();
        for (std::size_t k = 0; k < panel_.curves.size(); ++k) add_curve(k);
        return text_ + (in_space_ ? "splot " : "plot ") + comma_list(plots_, {}, ", \\\n     ") + "\n";
    }

  private:
    void set_labels()
    {
        for (std::size_t i = 0; i < panel_.labels.size(); ++i)
            text_ += fmt::format("set {}label {}{}\n", "xyz"[i], gnuplot_text(panel_.labels[i]),
                                 i == 2 ? " rotate by 90" : "");
    }

    void set_plane(bool abscissa)
    {
        text_ += plane_look;
        set_labels();
        if (panel_.over_time && box_.low[0] < box_.high[0]) text_ += range_script('x', box_.low[0], box_.high[0]);
        if (!panel_.over_time) text_ += "set offsets graph 0.04, graph 0.04, graph 0.04, graph 0.04\n";
        if (!abscissa) text_ += "unset xlabel\nset format x ''\n";
    }

    void set_room()
    {
        text_ += fmt::format("{}set border 4095 linecolor rgb '#c4c4c4'\nset tics nomirror textcolor rgb 'black'\n{}",
                             space_look, View().script(1));
        if (panel_.equal) text_ += "set view equal xyz\n";
        set_labels();
        for (std::size_t i = 0; i < 3; ++i) {
            const double extent = box_.high[i] - box_.low[i], size = std::fabs(box_.low[i]);
            const double margin = extent > 1e-9 * size ? 0.04 * extent : size == 0 ? 1 : 0.1 * size;
            text_ += range_script("xyz"[i], box_.low[i] - margin, box_.high[i] + margin);
            floor_ = box_.low[i] - margin;
        }
        text_ += fmt::format("set xyplane at {}\n", floor_);
    }

    /// Meridians and parallels, and the axes outside.
    void set_sphere()
    {
        view_ = view_of(panel_.curves);
        const double tip = 1.3 * radius_;
        text_ += fmt::format("{}unset border\nunset tics\n{}set view equal xyz\nset parametric\nset isosamples 13,7\n"
                             "set samples 61\nset urange [0:2*pi]\nset vrange [-pi/2:pi/2]\nset xyplane at {}\n",
                             space_look, view_.script(1.7), -tip);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at = [&](double r) {
                return fmt::format("{},{},{}", i == 0 ? r : 0, i == 1 ? r : 0, i == 2 ? r : 0);
            };
            text_ += range_script("xyz"[i], -tip, tip);
            text_ +=
                fmt::format("set arrow from {} to {} nohead linecolor rgb '#555555'\nset label {} at {} center\n",
                            at(radius_), at(tip), gnuplot_text(panel_.labels[i]), at((i < 2 ? 1.65 : 1.42) * radius_));
        }
        text_ += fmt::format("set label {} at 0,0,{} center\n",
                             gnuplot_text(fmt::format("sphere of radius {:.6g}", radius_)), -1.5 * radius_);
        plots_.push_back(
            fmt::format("{0}*cos(u)*cos(v),{0}*sin(u)*cos(v),{0}*sin(v) with {1} notitle", radius_, grid_style));
    }

    void add_curve(std::size_t k)
    {
        const Pen pen = pen_of(panel_.curves[k], panel_);
        const std::vector<SampledCurve> pieces = seen_pieces(panel_.curves[k], box_, pen);
        text_ += fmt::format("$curve{} << LAGEN_END\n", k);
        for (const SampledCurve& piece : pieces) {
            for (const PlotPoint& point : piece)
                text_ += fmt::format("{} {} {}{}\n", point[0], point[1], point[2],
                                     radius_ > 0 ? colour_at(k, view_.depth(point) < 0) : "");
            text_ += "\n";
        }
        text_ += "LAGEN_END\n";
        const std::string title = panel_.legends[k].empty() ? "notitle" : "title " + gnuplot_text(panel_.legends[k]);
        if (pieces.empty()) return plots_.push_back(fmt::format("NaN with lines linetype {} {}", k + 1, title));
        const std::string type = fmt::format("linetype {}{}", k + 1, radius_ > 0 ? " linecolor rgb variable" : "");
        const char* columns = radius_ > 0 ? "1:2:3:4" : in_space_ ? "1:2:3" : "1:2";
        if (in_space_ && radius_ == 0 && pen == Pen::line)
            plots_.push_back(fmt::format("$curve{} using 1:2:({}) with {} notitle", k, floor_, shadow_style));
        const char* drawn = pen == Pen::line ? "lines" : pen == Pen::steps ? "linespoints" : "points";
        plots_.push_back(fmt::format("$curve{} using {} with {} {}{} {}", k, columns, drawn, type,
                                     pen == Pen::steps ? " linewidth 0.6" : "", title));
        if (!panel_.over_time && panel_.pen == Pen::line)
            plots_.push_back(fmt::format("$curve{} every 1:1:0:0:0:0 using {} with points {} pointsize 0.7 notitle", k,
                                         columns, type));
    }

    const Panel& panel_;
    PlotBox box_;
    bool in_space_;
    View view_;
    double radius_ = 0, floor_ = 0;
    std::string text_;
    std::vector<std::string> plots_;
};

/// With its axis, where it has numbers, and its legend.
int height_of(const Panel& panel, int width, bool abscissa)
{
    int height = panel.over_time ? series_height : panel.labels.size() > 2 ? space_height : plane_height;
    if (panel.equal && panel.labels.size() == 2) {
        const PlotBox box = box_of(panel.curves);
        const double x = box.high[0] - box.low[0], y = box.high[1] - box.low[1];
        height = static_cast<int>(
            std::clamp((width - beside_panel) * (x > 0 ? y / x : 1), double{least_equal}, double{most_equal}));
    }
    std::size_t longest = 0;
    for (const std::string& each : panel.legends) longest = std::max(longest, columns_of(each));
    const int columns = std::max(1, (width - beside_panel) / (8 * static_cast<int>(longest) + 60));
    const int rows = longest == 0 ? 0 : (static_cast<int>(panel.legends.size()) + columns - 1) / columns;
    return height + (abscissa ? axis_height : bare_height) + rows * legend_height;
}

} // namespace

PlotBox box_of(const std::vector<SampledCurve>& curves)
{
    PlotBox box;
    bool found = false;
    for (const SampledCurve& curve : curves)
        for (const PlotPoint& point : curve) {
            if (!is_finite(point)) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                box.low[i] = found ? std::min(box.low[i], point[i]) : point[i];
                box.high[i] = found ? std::max(box.high[i], point[i]) : point[i];
            }
            found = true;
        }
    return box;
}

std::vector<SampledCurve> seen_pieces(const SampledCurve& curve, const PlotBox& box, Pen pen)
{
    std::vector<SampledCurve> pieces(1);
    for (const PlotPoint& point : curve) {
        if (is_finite(point))
            pieces.back().push_back(point);
        else if (!pieces.back().empty())
            pieces.emplace_back();
    }
    if (pieces.back().empty()) pieces.pop_back();
    for (SampledCurve& piece : pieces) {
        SampledCurve scaled = piece;
        for (PlotPoint& point : scaled)
            for (std::size_t i = 0; i < 3; ++i)
                point[i] = box.high[i] > box.low[i] ? (point[i] - box.low[i]) / (box.high[i] - box.low[i]) : 0;
        const std::vector<bool> seen = seen_points(scaled, pen);
        SampledCurve kept;
        for (std::size_t k = 0; k < piece.size(); ++k)
            if (seen[k]) kept.push_back(piece[k]);
        piece = std::move(kept);
    }
    return pieces;
}

std::string page_script(const std::vector<Panel>& panels, const std::string& title, const std::string& picture)
{
    const int width = std::ranges::any_of(panels, &Panel::over_time) ? broad_page : narrow_page;
    std::vector<bool> abscissas; // of functions of time below one another the last one alone has it
    std::vector<int> heights;
    int height = title_height;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        abscissas.push_back(k + 1 == panels.size() || !panels[k].over_time || !panels[k + 1].over_time);
        heights.push_back(height_of(panels[k], width, abscissas[k]));
        height += heights[k];
    }
    std::string script =
        gnuplot_terminal(picture_extension(picture), width, height) +
        fmt::format("set output {}\nset multiplot title {}\n", gnuplot_text(picture), gnuplot_text(title));
    for (std::size_t k = 0; k < 3 * picture_colours.size(); ++k) // as lines, then the same dashed and dotted
        script +=
            fmt::format("set linetype {} linecolor rgb '{}' linewidth 1.6 dashtype {} pointtype 7 pointsize 0.4\n",
                        k + 1, picture_colours[k % picture_colours.size()], k / picture_colours.size() + 1);
    int top = title_height;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        top += heights[k];
        script += fmt::format("reset\nset size {}1,{:.5f}\nset origin 0,{:.5f}\nset key above left horizontal Left "
                              "reverse\n",
                              panels[k].equal && panels[k].labels.size() == 2 ? "ratio -1 " : "",
                              static_cast<double>(heights[k]) / height, 1 - static_cast<double>(top) / height) +
                  PanelScript(panels[k]).text(abscissas[k]);
    }
    return script + "unset multiplot\nunset output\n";
}

void draw_panels(const std::vector<Panel>& panels, const std::string& title, const std::string& path)
{
    draw_picture(path, [&](const std::string& picture) { return page_script(panels, title, picture); });
}

} // namespace lagen
