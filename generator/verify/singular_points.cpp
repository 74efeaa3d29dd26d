// SPDX-License-Identifier: GPL-2.0-or-later
/// Slices of a model: one variable is zero, the rest of the setting stays.
#include "verify/singular_points.hpp"

#include "graph/calculus/differentiate.hpp"
#include "verify/at_values.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t point_limit = 8;
/// One slice a variable is looked at: none may take long.
constexpr ProofBudget slice_budget{.products = 200'000};

/// A point of the slice `zero` where a determinant vanishes; it does on the whole slice. None where something is not
/// defined on the slice, or the constraints are not triangular there.
std::optional<NamedPoint> singular_point(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                         const Replacements& zero, const std::vector<NodeId>& determinants)
{
    const std::optional<ProofSetting> slice = replaced(graph, setting, zero);
    const auto there = substitute_where_defined(graph, determinants, zero);
    if (!slice || !there) return {};
    const std::unique_ptr<ZeroDecider> decider = ZeroDecider::make(graph, *slice, smaller(budget, slice_budget));
    std::optional<NamedPoint> point = decider ? decider->sample_point() : std::nullopt;
    if (!point) return {};
    for (const NodeId determinant : *there)
        if (decider->status(determinant) == ProofStatus::proved) return point;
    return {};
}

} // namespace

std::vector<NamedPoint> singular_points(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                        const std::vector<NodeId>& determinants)
{
    std::vector<NamedPoint> points;
    for (std::size_t k = 0; k < setting.variables.size() && points.size() < point_limit; ++k) {
        const NodeId variable = setting.variables[k];
        std::optional<NamedPoint> point =
            singular_point(graph, setting, budget, {{variable, graph.constant(0)}}, determinants);
        if (!point) continue;
        point->insert(point->begin() + static_cast<std::ptrdiff_t>(k), {graph.input_name(variable), Rational(0)});
        points.push_back(std::move(*point));
    }
    return points;
}

} // namespace lagen
