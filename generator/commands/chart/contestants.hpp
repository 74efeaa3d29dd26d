// SPDX-License-Identifier: GPL-2.0-or-later
/// Which methods a chart compares, and the programs that run them: one for all methods of a family.
#pragma once

#include "commands/chart/chart.hpp"
#include "commands/chart/problem.hpp"
#include "commands/machine/compile.hpp"

namespace lagen {

struct Contestant {
    std::string name;
    bool adaptive = true; ///< climbs a ladder of tolerances, else of steps
};

struct MethodFamily {
    std::string peer; ///< the library; empty: lagen's own
    std::vector<Contestant> methods;
    ProgramText text;
    std::string program; ///< path, once it is compiled
};

/// Why the method does not apply, in terms of the model; empty where it does.
[[nodiscard]] std::string obstacle_to(const MethodEntry& method, const ChartProblem& problem);

/// The methods that are wanted, by families; where none is named all that apply, and those that do not are told with
/// the reason. Throws where one that is wanted does not apply.
[[nodiscard]] std::vector<MethodFamily> method_families(const ChartProblem& problem,
                                                        const std::vector<const MethodEntry*>& wanted,
                                                        std::vector<LeftOutMethod>& left_out);

/// The libraries that are installed; those that are not are told with their packages.
[[nodiscard]] std::vector<MethodFamily> peer_families(const ChartProblem& problem,
                                                      std::vector<LeftOutMethod>& left_out);

} // namespace lagen
