// SPDX-License-Identifier: GPL-2.0-or-later
/// Panels below one another on a page, drawn by gnuplot.
#pragma once

#include "commands/plot/drawing.hpp"

namespace lagen {

/// Draws `path` (.svg, .png or .pdf by its extension). All panels have the same left and right edges. Legends stand at
/// the right of them, or below in columns where they are too long or too broad for that, and name every curve; a name
/// alone that is broader than the page is cut. Throws MachineError where gnuplot is missing or fails.
void draw_page(const std::vector<Drawing>& panels, const std::string& title, const std::string& path);

/// Pixels along the axes of a panel, for labels: the longest that fit.
inline constexpr int longest_x_label = 500, longest_y_label = 260, longest_space_label = 120;

} // namespace lagen
