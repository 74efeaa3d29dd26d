// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/sphere.hpp"

#include "commands/plot/labels.hpp"
#include "commands/plot/page.hpp"
#include "commands/plot/projection.hpp"
#include "commands/plot/styles.hpp"
#include "commands/plot/thinned.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace lagen {

namespace {

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

/// What lies on one side.
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

} // namespace

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

} // namespace lagen
