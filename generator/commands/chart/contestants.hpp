// SPDX-License-Identifier: GPL-2.0-or-later
/// Which methods a chart compares, and the programs that run them: one for all methods of a family.
#pragma once

#include "commands/chart/chart.hpp"
#include "commands/chart/problem.hpp"
#include "commands/compile.hpp"

namespace lagen {

struct MethodFamily {
    std::vector<const MethodEntry*> methods; ///< that apply
    std::string program;                     ///< path, once it is compiled
};

/// Why the method does not apply, in terms of the model; empty where it does.
[[nodiscard]] std::string obstacle_to(const MethodEntry& method, const ChartProblem& problem);

/// All methods that apply, by families; those that do not are told with the reason.
[[nodiscard]] std::vector<MethodFamily> method_families(const ChartProblem& problem,
                                                        std::vector<LeftOutMethod>& left_out);

[[nodiscard]] ProgramText family_program(const ChartProblem& problem, const MethodFamily& family);

} // namespace lagen
