// SPDX-License-Identifier: GPL-2.0-or-later
/// A chart as pictures: time and calls of the right-hand side over the error, and time over the drift of each
/// invariant, all with logarithmic axes.
#pragma once

#include "commands/chart/chart.hpp"

namespace lagen {

/// Draws into `path` (.svg or .png). Methods that come near the cheapest one anywhere are drawn in colour and named at
/// their curves, the others thin; runs that failed are crosses in the column on the left.
void draw_chart(const Chart& chart, const std::string& path);

/// The same with the drift of what the equations conserve in the place of the error, four invariants at most; methods
/// that lead in a drift alone are coloured too. False where nothing is conserved.
bool draw_drifts(const Chart& chart, const std::string& path);

/// Methods that are the cheapest for some error of 1e-2 or less, or take at most so many times as long as that.
[[nodiscard]] std::vector<std::string> leading_methods(const Chart& chart, double times);

} // namespace lagen
