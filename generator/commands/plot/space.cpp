// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/box.hpp"
#include "commands/plot/projection.hpp"
#include "commands/plot/sphere.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

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
