// SPDX-License-Identifier: GPL-2.0-or-later
/// Panels of curves below one another on a page, drawn by gnuplot.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lagen {

using PlotPoint = std::array<double, 3>;
/// A curve as it was computed: (x, y, 0) or (x, y, z) at each time; a coordinate that is no finite number is a gap.
using SampledCurve = std::vector<PlotPoint>;

/// How curves are drawn.
enum class Pen {
    line,   ///< a motion in continuous time
    steps,  ///< points joined by thin lines
    points, ///< points alone
};

struct Panel {
    std::vector<SampledCurve> curves;
    std::vector<std::string> legends; ///< one a curve; empty where it has none
    std::vector<std::string> labels;  ///< of the axes, two or three
    Pen pen = Pen::line;
    bool over_time = false; ///< the abscissa is t: broad and low
    bool equal = false;     ///< one scale on all axes
    std::optional<bool>
        sphere{}; ///< in space; absent: where all points are equally far from the origin, to a thousandth
};

/// The smallest and the largest coordinates of all points without gaps; equal where there are none.
struct PlotBox {
    PlotPoint low{}, high{};
};
[[nodiscard]] PlotBox box_of(const std::vector<SampledCurve>& curves);

/// The pieces of a curve between its gaps, with no more points than can be seen: of a line its ends and as few others
/// as keep it within 1/4000 of the extents of `box` [Douglas-Peucker 1973], of points one in each cell of 1/400, of
/// steps all.
[[nodiscard]] std::vector<SampledCurve> seen_pieces(const SampledCurve& curve, const PlotBox& box, Pen pen);

/// The script for gnuplot. Curves in the plane that are no functions of t have a dot where they begin, curves in space
/// are seen from 35 degrees of azimuth and 25 of elevation. On a sphere around the origin what lies on the back is
/// pale, and the view is from another octant where the curves would lie there; others stand in a box with their shadow
/// on its floor.
[[nodiscard]] std::string page_script(const std::vector<Panel>& panels, const std::string& title,
                                      const std::string& picture);

/// Draws `path` (.svg, .png or .pdf by its extension). Throws MachineError where gnuplot is missing or fails.
void draw_panels(const std::vector<Panel>& panels, const std::string& title, const std::string& path);

} // namespace lagen
