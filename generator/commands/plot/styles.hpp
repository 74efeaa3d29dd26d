// SPDX-License-Identifier: GPL-2.0-or-later
/// How the k-th curve of a panel looks.
#pragma once

#include "commands/plot/drawing.hpp"

namespace lagen {

inline constexpr const char* axis_style = "lines linecolor rgb '#555555' linewidth 1 dashtype 1";

/// The eight colours as lines, then the same dashed and dotted.
[[nodiscard]] std::string line_style(std::size_t k, double width);
/// The same, paler and thinner: what lies behind.
[[nodiscard]] std::string hidden_style(std::size_t k);
[[nodiscard]] std::string point_style(std::size_t k, double size, bool hidden = false);

/// The strokes of pieces of the k-th curve, all of which lie behind or none.
[[nodiscard]] std::vector<Stroke> strokes_of(const std::vector<Polyline>& pieces, bool hidden, std::size_t k, Pen pen);

/// A dot where the curve begins.
[[nodiscard]] Stroke start_of(const Point& point, std::size_t k);

} // namespace lagen
