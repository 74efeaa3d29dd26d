// SPDX-License-Identifier: GPL-2.0-or-later
/// A chart in words and numbers.
#pragma once

#include "commands/chart/chart.hpp"
#include "text/record.hpp"

namespace lagen {

/// The object of chart.json.
[[nodiscard]] std::string chart_json(const Chart& chart);
[[nodiscard]] Record record_of(const std::vector<LeftOutMethod>& left_out);

/// RFC 4180: a line a point; a field that does not apply is empty.
[[nodiscard]] std::string chart_csv(const Chart& chart);

/// For standard output: the reference, the best point for each of `charted_errors`, what each method takes for them,
/// and what failed or was left out.
[[nodiscard]] std::string chart_text(const Chart& chart);

/// "tolerance 1e-09" or "step 0.1".
[[nodiscard]] std::string parameter_text(const ChartPoint& point);

/// The methods of a chart, peers with their libraries ("odeint dopri5"), in the order of its points.
[[nodiscard]] std::vector<std::string> charted_methods(const Chart& chart);
[[nodiscard]] std::string name_of(const ChartPoint& point);

/// What the equations conserve, by the names of its drifts.
[[nodiscard]] std::vector<std::string> charted_invariants(const Chart& chart);

// A chart as pictures: time and calls of the right-hand side over the error, and time over the drift of each
// invariant, all with logarithmic axes.

/// Draws into `path` (.svg or .png). Methods that come near the cheapest one anywhere are drawn in colour and named at
/// their curves, the others thin; runs that failed are crosses in the column on the left.
void draw_chart(const Chart& chart, const std::string& path);

/// The same with the drift of what the equations conserve in the place of the error, four invariants at most; methods
/// that lead in a drift alone are coloured too. False where nothing is conserved.
bool draw_drifts(const Chart& chart, const std::string& path);

/// Methods that are the cheapest for some error of 1e-2 or less, or take at most so many times as long as that.
[[nodiscard]] std::vector<std::string> leading_methods(const Chart& chart, double times);

} // namespace lagen
