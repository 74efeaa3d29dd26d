// SPDX-License-Identifier: GPL-2.0-or-later
/// Curves as a panel: in the plane, or in space.
#pragma once

#include "commands/plot/drawing.hpp"
#include "expression/symbol.hpp"

#include <optional>

namespace lagen {

struct PanelRequest {
    std::vector<SampledCurve> curves;
    std::vector<std::vector<Symbol>> symbols; ///< of the coordinates of each
    std::vector<std::string> runs{};          ///< of several, whose curves stand behind one another: their names
    std::string ordinate;                     ///< what several curves have in common; empty: their names say it
    Pen pen = Pen::line;
    bool equal = false;         ///< one scale on all axes
    std::optional<bool> sphere; ///< in space; absent: where all points are equally far from the origin, to a thousandth
};

/// Graphs over t, or curves with a dot where they begin. Of graphs that differ from their starts by less than 1e-4 of
/// their size the change is drawn: no axis has room for so many digits.
[[nodiscard]] Drawing draw_in_plane(const PanelRequest& request);

/// Curves in space, projected by parallel rays from (cos 25° cos 35°, cos 25° sin 35°, sin 25°). On a sphere around the
/// origin, drawn by its meridians and parallels with the axes outside, what lies on the back is pale, and the view is
/// from another octant where the curves would lie there. Other curves stand in a box with axes, their shadow on its
/// floor.
[[nodiscard]] Drawing draw_in_space(const PanelRequest& request);

/// The legend: nothing for a curve alone. Curves of several runs have the names of their runs.
void add_legend(Drawing& drawing, const PanelRequest& request);

/// The symbols of one coordinate, a curve each.
[[nodiscard]] std::vector<Symbol> symbols_along(const PanelRequest& request, std::size_t axis);

} // namespace lagen
