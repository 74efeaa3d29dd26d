// SPDX-License-Identifier: GPL-2.0-or-later
/// The order of convergence that a series of runs shows: the least-squares slope of log(error) against log(h), after a
/// plateau filter.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace lagen::support {

struct ErrorPoint {
    long double h;
    long double error;
};

/// Slope over the points, coarse to fine, that lie above `floor` (round-off) and still decrease; NaN where fewer than
/// three do, so that every comparison with it fails.
inline double measured_order(const std::vector<ErrorPoint>& points, long double floor)
{
    std::vector<ErrorPoint> kept;
    for (const ErrorPoint& point : points) {
        if (!(point.error > floor) || (!kept.empty() && !(point.error < kept.back().error))) break;
        kept.push_back(point);
    }
    if (kept.size() < 3) return std::nan("");
    long double x = 0, y = 0, xx = 0, xy = 0;
    for (const ErrorPoint& point : kept) {
        const long double u = std::log(point.h), v = std::log(point.error);
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    const auto n = static_cast<long double>(kept.size());
    return static_cast<double>((n * xy - x * y) / (n * xx - x * x));
}

} // namespace lagen::support
