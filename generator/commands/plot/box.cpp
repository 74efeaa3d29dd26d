// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/box.hpp"

#include "commands/plot/labels.hpp"
#include "commands/plot/page.hpp"
#include "commands/plot/projection.hpp"
#include "commands/plot/styles.hpp"
#include "commands/plot/thinned.hpp"
#include "commands/plot/ticks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lagen {

namespace {

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

} // namespace

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

} // namespace lagen
