// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/system.hpp"

#include <algorithm>

namespace lagen {

bool ControlProblem::bounded() const
{
    const auto given = [](const std::optional<NodeId>& bound) { return bound.has_value(); };
    return std::ranges::any_of(lower, given) || std::ranges::any_of(upper, given);
}

std::vector<NodeId> System::forces_or_zero(Graph& copy) const
{
    return forces.empty() ? std::vector<NodeId>(r(), copy.constant(0)) : forces;
}

bool System::declares(const std::string& wanted) const
{
    const auto among = [&](const std::vector<NodeId>& inputs) {
        return std::ranges::any_of(inputs, [&](NodeId input) { return graph.input_name(input) == wanted; });
    };
    return among(parameters) || among(algebroid.x) || among(algebroid.y) || among(velocities()) || among(inputs) ||
           among(states) || (control && among(control->u));
}

Replacements replacements(const std::vector<NodeId>& inputs, const std::vector<NodeId>& nodes)
{
    Replacements result;
    for (std::size_t k = 0; k < inputs.size(); ++k) result.emplace_back(inputs[k], nodes[k]);
    return result;
}

} // namespace lagen
