// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/small_lanes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace lagen {

std::string below_absolute_warning(const std::string& lanes, const std::string& tolerance)
{
    return fmt::format("warning: {} moved and never exceeded the absolute tolerance{}{}: the digits may be noise\n"
                       "hint: `absolute` in the scene far below them, or other units\n",
                       lanes, tolerance.empty() ? "" : " ", tolerance);
}

std::string small_lanes_warning(const std::vector<SmallLane>& lanes, const std::string& tolerance)
{
    constexpr std::size_t most = 6; // in a line
    std::string names;
    for (std::size_t k = 0; k < std::min(lanes.size(), most); ++k)
        names += fmt::format("{}{} (at most {:.2g})", k == 0 ? "" : ", ", lanes[k].name,
                             std::strtod(lanes[k].most.c_str(), nullptr));
    if (lanes.size() > most) names += fmt::format(" and {} more", lanes.size() - most);
    return lanes.empty() ? "" : below_absolute_warning(names, tolerance);
}

} // namespace lagen
