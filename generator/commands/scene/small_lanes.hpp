// SPDX-License-Identifier: GPL-2.0-or-later
/// Lanes of the state that moved and never exceeded the absolute tolerance, but for the errors that it allows (ten
/// times it): steps that are as accurate as their tolerances ask for no digit of them.
#pragma once

#include <string>
#include <vector>

namespace lagen {

/// Its name, and the most that it came to, as printed.
struct SmallLane {
    std::string name, most;
};

/// "warning: LANES moved and never exceeded the absolute tolerance ..": the sentence of runs and sweeps.
[[nodiscard]] std::string below_absolute_warning(const std::string& lanes, const std::string& tolerance);

/// The same of one run; "" where there is no such lane.
[[nodiscard]] std::string small_lanes_warning(const std::vector<SmallLane>& lanes, const std::string& tolerance);

} // namespace lagen
