// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/labels.hpp"
#include "commands/plot/page.hpp"
#include "commands/plot/panel.hpp"
#include "commands/plot/projection.hpp"
#include "commands/plot/styles.hpp"
#include "commands/plot/thinned.hpp"
#include "commands/plot/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <numbers>

namespace lagen {

namespace {

// Curves on a sphere around the origin.

constexpr const char* front_grid = "lines linecolor rgb '#c4c4c4' linewidth 0.7 dashtype 1";
constexpr const char* back_grid = "lines linecolor rgb '#e9e9e9' linewidth 0.6 dashtype 1";
constexpr const char* outline = "lines linecolor rgb '#9a9a9a' linewidth 0.9 dashtype 1";

/// The octant from which most of the curves is seen; the first one where it will do.
PictureProjection view_of(const std::vector<SampledCurve>& curves)
{
    Vector mean{0, 0, 0};
    for (const SampledCurve& curve : curves)
        for (const Vector& point : curve)
            if (is_finite(point))
                for (std::size_t i = 0; i < 3; ++i) mean[i] += point[i];
    PictureProjection best(usual_azimuth, usual_elevation);
    if (best.depth(mean) >= 0) return best;
    for (const double up : {usual_elevation, -usual_elevation})
        for (const double turn : {90.0, 180.0, 270.0, 0.0}) {
            const PictureProjection other(usual_azimuth + turn, up);
            if (other.depth(mean) > best.depth(mean)) best = other;
        }
    return best;
}

/// The pieces of a curve on one side: a segment is where it begins.
std::vector<Polyline> side_of(const SampledCurve& curve, const PictureProjection& project, bool behind)
{
    std::vector<Polyline> pieces;
    bool open = false;
    for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
        const bool here = is_finite(curve[k]) && is_finite(curve[k + 1]) && (project.depth(curve[k]) < 0) == behind;
        if (here && !open) pieces.push_back({project(curve[k])});
        if (here) pieces.back().push_back(project(curve[k + 1]));
        open = here;
    }
    return pieces;
}

/// The points on one side.
std::vector<Polyline> points_of(const SampledCurve& curve, const PictureProjection& project, bool behind)
{
    Polyline points;
    for (const Vector& point : curve)
        if (is_finite(point) && (project.depth(point) < 0) == behind) points.push_back(project(point));
    return points.empty() ? std::vector<Polyline>{} : std::vector<Polyline>{points};
}

/// The meridian of an angle, or the parallel, both in degrees.
SampledCurve circle(double radius, bool meridian, double angle)
{
    SampledCurve curve;
    const double fixed = angle * std::numbers::pi / 180;
    for (int k = 0; k <= 120; ++k) {
        const double along = k * std::numbers::pi / 60;
        const double a = meridian ? fixed : along, e = meridian ? along : fixed;
        curve.push_back({radius * std::cos(e) * std::cos(a), radius * std::cos(e) * std::sin(a), radius * std::sin(e)});
    }
    return curve;
}

void add_grid(Drawing& drawing, const PictureProjection& project, double radius)
{
    std::vector<SampledCurve> grid;
    for (const double angle : {0.0, 30.0, 60.0, 90.0, 120.0, 150.0}) grid.push_back(circle(radius, true, angle));
    for (const double angle : {-60.0, -30.0, 0.0, 30.0, 60.0}) grid.push_back(circle(radius, false, angle));
    for (const bool behind : {true, false}) {
        Stroke stroke{behind ? back_grid : front_grid, {}, false};
        for (const SampledCurve& each : grid)
            for (Polyline& piece : side_of(each, project, behind)) stroke.lines.push_back(std::move(piece));
        drawing.strokes.push_back(std::move(stroke));
    }
    Polyline edge;
    for (int k = 0; k <= 120; ++k)
        edge.push_back({radius * std::cos(k * std::numbers::pi / 60), radius * std::sin(k * std::numbers::pi / 60)});
    drawing.strokes.push_back({outline, {edge}, false});
}

/// The axes, from the sphere outwards, those that point away up to its edge hidden.
void add_axes(Drawing& drawing, const PanelRequest& request, const PictureProjection& project, double radius)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const auto at = [&](double times) {
            Vector r{0, 0, 0};
            r[i] = times * radius;
            return project(r);
        };
        const bool towards = project.towards()[i] >= 0;
        const double from = towards ? 1 : 1 / std::hypot(at(1 / radius).x, at(1 / radius).y);
        const double to = std::max(from + 0.12, 1.3);
        drawing.strokes.push_back({axis_style, {{at(from), at(to)}}, false});
        const Point tip = at(to);
        const double far = std::hypot(tip.x, tip.y);
        const Point text{tip.x + 0.07 * radius * tip.x / far, tip.y + 0.07 * radius * tip.y / far};
        const bool level = std::fabs(tip.x) > 0.35 * far;
        drawing.marks.push_back({text, axis_label(symbols_along(request, i), longest_space_label, false),
                                 !level      ? Align::centre
                                 : tip.x < 0 ? Align::right
                                             : Align::left});
    }
}

/// Adds the parts of a curve that lie on one side of the sphere.
void add_curve(Drawing& drawing, const SampledCurve& curve, std::size_t k, Pen pen, const PictureProjection& project,
               bool behind)
{
    const auto add = [&](std::vector<Stroke> strokes) {
        for (Stroke& stroke : strokes) drawing.strokes.push_back(std::move(stroke));
    };
    if (pen == Pen::line) return add(strokes_of(side_of(curve, project, behind), behind, k, pen));
    if (pen == Pen::steps && !behind) add({{line_style(k, 0.5), side_of(curve, project, false), false}});
    add(strokes_of(points_of(curve, project, behind), behind, k, Pen::points));
}

Drawing draw_on_sphere(const PanelRequest& request, double radius)
{
    Drawing drawing;
    drawing.frame = false;
    drawing.equal = true;
    const PictureProjection project = view_of(request.curves);
    add_grid(drawing, project, radius);
    add_axes(drawing, request, project, radius);
    for (const bool behind : {true, false})
        for (std::size_t k = 0; k < request.curves.size(); ++k)
            add_curve(drawing, request.curves[k], k, request.pen, project, behind);
    for (std::size_t k = 0; k < request.curves.size() && request.pen == Pen::line; ++k)
        if (const SampledCurve& curve = request.curves[k]; !curve.empty() && is_finite(curve[0]))
            drawing.strokes.push_back(start_of(project(curve[0]), k));
    drawing.x_label = fmt::format("sphere of radius {:.6g}", radius);
    return drawing;
}

// Curves in a box with axes.

constexpr const char* edge_style = "lines linecolor rgb '#c4c4c4' linewidth 0.8 dashtype 1";
constexpr const char* shadow_style = "lines linecolor rgb '#d0d0d0' linewidth 1 dashtype 1";

/// The box of the curves, and its image: the longest edge has length 1; of edges that are not `equal` the two on the
/// floor have.
struct Room {
    Vector low, high, size;

    [[nodiscard]] Vector inside(const Vector& r) const
    {
        Vector out{};
        for (std::size_t i = 0; i < 3; ++i) out[i] = ((r[i] - low[i]) / (high[i] - low[i]) - 0.5) * size[i];
        return out;
    }
};

Room room_of(const PanelRequest& request)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Room room{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, {1, 1, 0.8}};
    for (const SampledCurve& curve : request.curves)
        for (const Vector& point : curve)
            for (std::size_t i = 0; i < 3 && is_finite(point); ++i) {
                room.low[i] = std::min(room.low[i], point[i]);
                room.high[i] = std::max(room.high[i], point[i]);
            }
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(room.low[i] <= room.high[i])) room.low[i] = room.high[i] = 0;
        const double extent = room.high[i] - room.low[i];
        const double least = 1e-9 * std::max(std::fabs(room.low[i]), std::fabs(room.high[i]));
        const double margin = extent > least ? 0.04 * extent : room.low[i] == 0 ? 1 : 0.1 * std::fabs(room.low[i]);
        room.low[i] -= margin;
        room.high[i] += margin;
        longest = std::max(longest, room.high[i] - room.low[i]);
    }
    for (std::size_t i = 0; i < 3 && request.equal; ++i) room.size[i] = (room.high[i] - room.low[i]) / longest;
    return room;
}

Vector corner(const Room& room, bool x, bool y, bool z)
{
    return room.inside(
        {x ? room.high[0] : room.low[0], y ? room.high[1] : room.low[1], z ? room.high[2] : room.low[2]});
}

/// All edges but those at the corner next to the eye.
void add_edges(Drawing& drawing, const PictureProjection& project, const Room& room)
{
    Stroke stroke{edge_style, {}, false};
    for (unsigned from = 0; from < 8; ++from)
        for (const unsigned along : {1U, 2U, 4U}) {
            const unsigned to = from | along;
            if (to == from || to == 7) continue; // the eye is in the first octant
            const auto at = [&](unsigned k) { return project(corner(room, (k & 1) != 0, (k & 2) != 0, (k & 4) != 0)); };
            stroke.lines.push_back({at(from), at(to)});
        }
    drawing.strokes.push_back(std::move(stroke));
}

/// The axis i along an edge of the box, its numbers outside.
void add_axis(Drawing& drawing, const PictureProjection& project, const Room& room, std::size_t i,
              const std::string& label)
{
    // The first two run along the edges of the floor that are nearer to the eye, the third at the left.
    const auto at = [&](double value) {
        Vector r{room.high[0], i == 2 ? room.low[1] : room.high[1], room.low[2]};
        r[i] = value;
        return project(room.inside(r));
    };
    const Point begin = at(room.low[i]), end = at(room.high[i]);
    const Point middle{(begin.x + end.x) / 2, (begin.y + end.y) / 2};
    const double run = std::hypot(end.x - begin.x, end.y - begin.y);
    Point outward{(end.y - begin.y) / run, -(end.x - begin.x) / run};
    if (outward.x * middle.x + outward.y * middle.y < 0) outward = {-outward.x, -outward.y};
    Stroke stroke{axis_style, {{begin, end}}, false};
    const Align align = i == 0 ? Align::left : Align::right;
    for (const double tick : round_ticks(room.low[i], room.high[i])) {
        const Point foot = at(tick);
        stroke.lines.push_back({foot, {foot.x + 0.02 * outward.x, foot.y + 0.02 * outward.y}});
        drawing.marks.push_back(
            {{foot.x + 0.04 * outward.x, foot.y + 0.045 * outward.y}, fmt::format("{:.6g}", tick), align});
    }
    drawing.strokes.push_back(std::move(stroke));
    const double away = i == 2 ? 0.05 : 0.17;
    drawing.marks.push_back(i == 2 ? Mark{{end.x, end.y + away}, label, Align::centre}
                                   : Mark{{middle.x + away * outward.x, middle.y + away * outward.y}, label, align});
}

SampledCurve image_of(const SampledCurve& curve, const Room& room, const PictureProjection& project, bool shadow)
{
    SampledCurve out;
    for (const Vector& point : curve) {
        if (!is_finite(point)) {
            out.push_back(point);
            continue;
        }
        const Point image = project(room.inside({point[0], point[1], shadow ? room.low[2] : point[2]}));
        out.push_back({image.x, image.y, 0});
    }
    return out;
}

Drawing draw_in_box(const PanelRequest& request)
{
    Drawing drawing;
    drawing.frame = false;
    drawing.equal = true;
    const PictureProjection project(usual_azimuth, usual_elevation);
    const Room room = room_of(request);
    add_edges(drawing, project, room);
    for (const SampledCurve& curve : request.curves)
        if (request.pen == Pen::line)
            drawing.strokes.push_back({shadow_style, pieces_of(image_of(curve, room, project, true)), false});
    for (std::size_t k = 0; k < request.curves.size(); ++k) {
        const std::vector<Polyline> pieces = pieces_of(image_of(request.curves[k], room, project, false));
        for (Stroke& stroke : strokes_of(pieces, false, k, request.pen)) drawing.strokes.push_back(std::move(stroke));
        if (request.pen == Pen::line && !pieces.empty()) drawing.strokes.push_back(start_of(pieces[0][0], k));
    }
    for (std::size_t i = 0; i < 3; ++i)
        add_axis(drawing, project, room, i, axis_label(symbols_along(request, i), longest_space_label, false));
    return drawing;
}

constexpr double same_distance = 1e-3; // relative: less than can be seen

/// The distance of all points from the origin, if it is one.
std::optional<double> common_distance(const std::vector<SampledCurve>& curves)
{
    std::optional<double> radius;
    for (const SampledCurve& curve : curves)
        for (const Vector& point : curve) {
            if (!is_finite(point)) continue;
            if (!radius) radius = length(point);
            if (!(std::fabs(length(point) - *radius) <= same_distance * *radius)) return std::nullopt;
        }
    return radius && *radius > 0 ? radius : std::nullopt;
}

double largest_distance(const std::vector<SampledCurve>& curves)
{
    double largest = 0;
    for (const SampledCurve& curve : curves)
        for (const Vector& point : curve)
            if (is_finite(point)) largest = std::max(largest, length(point));
    return largest;
}

} // namespace

Drawing draw_in_space(const PanelRequest& request)
{
    const std::optional<double> radius = common_distance(request.curves);
    const double farthest = largest_distance(request.curves);
    const bool sphere = farthest > 0 && request.sphere.value_or(radius.has_value());
    Drawing drawing = sphere ? draw_on_sphere(request, radius.value_or(farthest)) : draw_in_box(request);
    add_legend(drawing, request);
    return drawing;
}

} // namespace lagen
