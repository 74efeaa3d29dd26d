// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/thinned.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace lagen {

namespace {

constexpr double seen = 0.15;        // pixels
constexpr std::size_t stretch = 500; // points that are thinned at a time: a turbulent curve costs their square at most

/// The distance of p from the segment between a and b, in pixels.
double distance(const Point& p, const Point& a, const Point& b, const Scale& scale)
{
    const double ux = (b.x - a.x) * scale.x, uy = (b.y - a.y) * scale.y;
    const double px = (p.x - a.x) * scale.x, py = (p.y - a.y) * scale.y;
    const double length = ux * ux + uy * uy;
    const double along = length > 0 ? std::clamp((px * ux + py * uy) / length, 0.0, 1.0) : 0;
    return std::hypot(px - along * ux, py - along * uy);
}

/// Marks what is kept between the ends of a stretch.
void keep_between(const Polyline& line, std::size_t first, std::size_t last, const Scale& scale,
                  std::vector<bool>& kept)
{
    std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        double farthest = seen;
        std::size_t at = from;
        for (std::size_t k = from + 1; k < to; ++k) {
            const double far = distance(line[k], line[from], line[to], scale);
            if (far > farthest) {
                farthest = far;
                at = k;
            }
        }
        if (at == from) continue;
        kept[at] = true;
        open.emplace_back(from, at);
        open.emplace_back(at, to);
    }
}

} // namespace

Polyline thinned(const Polyline& line, const Scale& scale)
{
    if (line.size() < 3) return line;
    std::vector<bool> kept(line.size(), false);
    kept.front() = kept.back() = true;
    for (std::size_t first = 0; first + 1 < line.size(); first += stretch) {
        const std::size_t last = std::min(first + stretch, line.size() - 1);
        kept[last] = true;
        keep_between(line, first, last, scale, kept);
    }
    Polyline out;
    for (std::size_t k = 0; k < line.size(); ++k)
        if (kept[k]) out.push_back(line[k]);
    return out;
}

Polyline distinct(const Polyline& points, const Scale& scale)
{
    std::set<std::pair<double, double>> seen_cells;
    Polyline out;
    for (const Point& point : points)
        if (seen_cells.emplace(std::round(point.x * scale.x), std::round(point.y * scale.y)).second)
            out.push_back(point);
    return out;
}

std::vector<Polyline> pieces_of(const SampledCurve& curve)
{
    std::vector<Polyline> pieces(1);
    for (const auto& point : curve) {
        if (std::isfinite(point[0]) && std::isfinite(point[1]))
            pieces.back().push_back({point[0], point[1]});
        else if (!pieces.back().empty())
            pieces.emplace_back();
    }
    if (pieces.back().empty()) pieces.pop_back();
    return pieces;
}

Box empty_box()
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity}, {-infinity, -infinity}};
}

void extend(Box& box, const std::vector<Polyline>& lines)
{
    for (const Polyline& line : lines)
        for (const Point& point : line) {
            box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y)};
            box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y)};
        }
}

} // namespace lagen
