// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/ticks.hpp"

#include <cmath>

namespace lagen {

std::vector<double> round_ticks(double low, double high)
{
    constexpr double wanted = 4;
    if (!(high > low) || !std::isfinite(high - low)) return {};
    const double rough = (high - low) / wanted;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double digit : {5.0, 2.0, 1.0})
        if (digit * power >= rough * 0.7) step = digit * power;
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
        ticks.push_back(k == 0 ? 0 : k * step); // no -0
    return ticks;
}

} // namespace lagen
