// SPDX-License-Identifier: GPL-2.0-or-later
/// The points of a chart: each program climbs the ladders of its methods, then repeats their points by turns with the
/// others, so that what disturbs the machine for a while disturbs all of them.
#pragma once

#include "commands/chart/contestants.hpp"
#include "commands/chart/reference.hpp"

namespace lagen {

/// Which points are there depends on numbers of steps and calls alone; what they cost, on the machine.
[[nodiscard]] std::vector<ChartPoint> measure_points(const ChartProblem& problem, const ChartReference& reference,
                                                     const std::vector<MethodFamily>& families, std::size_t& repeats);

} // namespace lagen
