// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/series/taylor.hpp"

#include "graph/core/operators.hpp"

#include <fmt/core.h>

#include <cctype>

namespace lagen {

void require_analytic(const Graph& graph, std::span<const NodeId> functions, std::span<const NodeId> coordinates,
                      std::span<const ImplicitBlock> blocks)
{
    const auto refuse = [](const std::string& what) {
        throw MathematicsError(
            fmt::format("a Taylor series does not see the kinks and jumps of {} along the motion: take another "
                        "method, such as dop853",
                        what));
    };
    std::vector<NodeId> roots(functions.begin(), functions.end()), moving(coordinates.begin(), coordinates.end());
    for (const ImplicitBlock& block : blocks) {
        if (block.bracket) refuse("what is searched for between bounds");
        roots.insert(roots.end(), block.residuals.begin(), block.residuals.end());
        moving.insert(moving.end(), block.unknowns.begin(), block.unknowns.end());
    }
    const std::vector<bool> moves = depends_on(graph, moving);
    for (const NodeId id : reachable(graph, roots)) {
        const Operator& row = operator_of(graph.op(id));
        const bool smooth = row.smoothness != Smoothness::kinked && row.smoothness != Smoothness::stepped &&
                            row.smoothness != Smoothness::chosen;
        if (!moves[id] || smooth) continue;
        const bool is_word = std::isalpha(static_cast<unsigned char>(row.name[0])) != 0;
        refuse(is_word ? std::string(row.name) + "()" : fmt::format("the comparison '{}'", row.name));
    }
}

} // namespace lagen
