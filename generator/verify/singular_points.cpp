// SPDX-License-Identifier: GPL-2.0-or-later
/// Slices of a model: one variable is zero, the rest of the setting stays.
#include "verify/singular_points.hpp"
#include "graph/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t point_limit = 8;
/// One slice a variable is looked at: none may take long.
constexpr ProofBudget slice_budget{.products = 200'000};

using Replacements = std::vector<std::pair<NodeId, NodeId>>;

/// A point of the slice `zero` where a determinant vanishes; it does on the whole slice.
std::optional<NamedPoint> singular_point(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                         const Replacements& zero, const std::vector<NodeId>& determinants)
{
    const ZeroDecider decider(graph, replaced(graph, setting, zero), smaller(budget, slice_budget));
    std::optional<NamedPoint> point = decider.sample_point();
    if (!point) return {};
    for (const NodeId determinant : substitute(graph, determinants, zero))
        if (decider.decide(determinant).status == ProofStatus::proved) return point;
    return {};
}

} // namespace

ProofSetting replaced(Graph& graph, const ProofSetting& setting, const Replacements& values)
{
    ProofSetting result = setting;
    for (const auto& [input, value] : values) {
        std::erase(result.variables, input);
        std::erase(result.parameters, input);
    }
    for (std::vector<NodeId>* nodes : {&result.constraints, &result.domain, &result.defined})
        *nodes = substitute(graph, *nodes, values);
    return result;
}

std::vector<NamedPoint> singular_points(Graph& graph, const ProofSetting& setting, const ProofBudget& budget,
                                        const std::vector<NodeId>& determinants)
{
    std::vector<NamedPoint> points;
    for (std::size_t k = 0; k < setting.variables.size() && points.size() < point_limit; ++k) {
        const NodeId variable = setting.variables[k];
        try {
            std::optional<NamedPoint> point =
                singular_point(graph, setting, budget, {{variable, graph.constant(0)}}, determinants);
            if (!point) continue;
            point->insert(point->begin() + static_cast<std::ptrdiff_t>(k), {graph.input_name(variable), "0"});
            points.push_back(std::move(*point));
        } catch (const Error&) {
            // A division by zero, or constraints that do not meet the slice: no point of the model is known here.
        }
    }
    return points;
}

} // namespace lagen
