// SPDX-License-Identifier: GPL-2.0-or-later
/// The reference of a chart: two methods in 113 bits, and their distance.
#pragma once

#include "commands/chart/problem.hpp"
#include "commands/machine/compile.hpp"

#include <array>

namespace lagen {

struct ChartReference {
    double error = 0;                 ///< the largest distance of the two
    std::vector<double> rows;         ///< high and low part of every lane, a sample after the other
    std::size_t steps = 0, calls = 0; ///< of the explicit pair
    std::string shortened;            ///< why the problem was shortened; empty where it was not
    bool ended_by_event = false;      ///< that is why
};

/// Taylor's method where there is one, else a pair of another order; then the pair that suits the equations.
[[nodiscard]] std::array<std::string, 2> reference_methods(const ChartProblem& problem);

/// The programs of the two.
[[nodiscard]] std::vector<ProgramText> reference_programs(const ChartProblem& problem);

/// Where an event ends the scene, or the two differ by more than 1e-14 from some time on, `problem` ends there. Throws
/// MathematicsError where that leaves no sample behind the start.
[[nodiscard]] ChartReference make_reference(ChartProblem& problem, const std::array<std::string, 2>& programs,
                                            const std::string& scene);

} // namespace lagen
