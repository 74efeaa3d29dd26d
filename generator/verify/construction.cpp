// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/construction.hpp"

#include "geometry/structure_equations.hpp"
#include "proof/almost_everywhere.hpp"

#include <algorithm>
#include <set>

namespace lagen {
namespace {

constexpr std::size_t determinant_points = 5; ///< at one of them a determinant is not zero

bool is_strict(Op op)
{
    const Trichotomy& holds = operator_of(op).holds;
    return (holds.below || holds.above) && !holds.equal;
}

} // namespace

bool holds_by_construction(const Construction& construction)
{
    Graph graph = construction.graph;
    ProofSetting setting;
    setting.variables = construction.x;
    setting.parameters = construction.parameters;
    setting.domain = construction.domain;
    const ZeroDecider decider(graph, setting);
    const auto is_zero = [&](NodeId node) {
        return graph.is_zero(node) || decider.status(node) == ProofStatus::proved;
    };
    // The domain is open.
    std::vector<NodeId> analytic = construction.analytic;
    for (const NodeId condition : construction.domain) {
        if (!is_strict(graph.op(condition))) return false;
        for (const NodeId side : graph.operands(condition)) analytic.push_back(side);
    }
    for (const Algebroid& algebroid : construction.algebroids)
        for (const NodeId entry : algebroid.entries()) analytic.push_back(entry);
    if (!are_analytic(graph, analytic, setting, decider)) return false;
    const auto not_zero_at_a_point = [&](NodeId node) {
        return decider.reevaluate(node, determinant_points).zero_excluded;
    };
    if (!std::ranges::all_of(construction.zero, is_zero) ||
        !std::ranges::all_of(construction.nonzero, not_zero_at_a_point))
        return false;
    return std::ranges::all_of(construction.algebroids, [&](const Algebroid& algebroid) {
        BaseGradient partial(graph, algebroid.x);
        std::set<NodeId> values;
        for (const Residual& residual : structure_equations(partial, algebroid).residuals)
            values.insert(residual.value);
        return std::ranges::all_of(values, is_zero);
    });
}

} // namespace lagen
