// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/group_lanes.hpp"

#include <algorithm>

namespace lagen {

std::vector<GroupLanes> group_lanes(const Model& model, const std::vector<std::size_t>& states, std::size_t before)
{
    std::vector<GroupLanes> matrices;
    for (const Reconstruction& g : model.reconstructions) {
        const auto place = std::ranges::find(states, g.first);
        if (place == states.end()) continue;
        GroupLanes& lanes = matrices.emplace_back();
        lanes.name = g.name;
        lanes.group = g.group;
        lanes.first = before + static_cast<std::size_t>(place - states.begin());
        lanes.size = g.size;
        for (std::size_t c = 0; c < g.generators.size(); ++c)
            for (std::size_t k = 0; k < g.size * g.size; ++k)
                if (const Rational& value = g.generators[c].entries[k]->number; value != 0)
                    lanes.generators.push_back({c, k / g.size, k % g.size, value});
    }
    return matrices;
}

} // namespace lagen
