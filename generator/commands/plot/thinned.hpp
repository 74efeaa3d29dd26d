// SPDX-License-Identifier: GPL-2.0-or-later
/// Curves with no more points than can be seen.
#pragma once

#include "commands/plot/drawing.hpp"

namespace lagen {

/// Pixels for a unit, along both axes.
struct Scale {
    double x = 1, y = 1;
};

/// The first and the last point of `line`, and of the others as few as keep it within 0.15 pixels [Douglas-Peucker
/// 1973].
[[nodiscard]] Polyline thinned(const Polyline& line, const Scale& scale);

/// One of the points that fall on the same pixel.
[[nodiscard]] Polyline distinct(const Polyline& points, const Scale& scale);

/// The runs of points in the plane between gaps.
[[nodiscard]] std::vector<Polyline> pieces_of(const SampledCurve& curve);

/// The box of all that `lines` hold, joined to `box`, which is empty at first (low above high).
void extend(Box& box, const std::vector<Polyline>& lines);
[[nodiscard]] Box empty_box();

} // namespace lagen
