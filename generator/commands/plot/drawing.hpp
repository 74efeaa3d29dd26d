// SPDX-License-Identifier: GPL-2.0-or-later
/// What is drawn, in the coordinates of a panel, before it is a page.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

struct Point {
    double x = 0, y = 0;
};
using Polyline = std::vector<Point>;

/// A curve as it was computed: (x, y) or (x, y, z) at each time; a coordinate that is no finite number is a gap.
using SampledCurve = std::vector<std::array<double, 3>>;

/// How curves are drawn.
enum class Pen {
    line,   ///< a motion in continuous time
    steps,  ///< points joined by thin lines
    points, ///< points alone
};

/// Lines or points in one style.
struct Stroke {
    std::string style; ///< as gnuplot takes it behind "with"
    std::vector<Polyline> lines;
    bool points = false; ///< each point stands alone
};

enum class Align { left, centre, right };

/// A text in the drawing.
struct Mark {
    Point at;
    std::string text;
    Align align = Align::centre;
};

/// Smallest and largest coordinates.
struct Box {
    Point low, high;
    [[nodiscard]] double width() const { return high.x - low.x; }
    [[nodiscard]] double height() const { return high.y - low.y; }
};

/// One panel of a page.
struct Drawing {
    std::vector<Stroke> strokes;
    std::vector<Mark> marks;
    std::string x_label, y_label;
    std::vector<std::pair<std::string, std::string>> legend; ///< style and text of each curve; or empty
    bool over_time = false;                                  ///< the abscissa is t: broad and low
    bool frame = true;  ///< axes with numbers; else the strokes have axes of their own
    bool equal = false; ///< one scale on both axes
    Box box;            ///< of all strokes
};

} // namespace lagen
