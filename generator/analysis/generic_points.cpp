// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/generic_points.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

constexpr long double dependent_vector = 1e-9L; ///< what is left of a vector that depends on others, of its length

} // namespace

ProofSetting setting_at_values(Graph& graph, ProofSetting setting, const Replacements& values)
{
    setting.parameters.clear();
    for (auto* nodes : {&setting.constraints, &setting.domain, &setting.defined})
        *nodes = substitute(graph, *nodes, values);
    std::erase_if(setting.defined, [&](NodeId node) { return graph.is_constant(node); });
    return setting;
}

std::vector<NamedNumbers> generic_points(const Graph& graph, const ProofSetting& setting, std::size_t count)
{
    std::vector<NamedNumbers> points;
    for (std::size_t seed = 0; points.size() < count && seed <= 2 * count; ++seed) {
        ProofBudget budget;
        budget.seed = seed;
        const auto decider = ZeroDecider::make(graph, setting, budget);
        if (!decider) return {};
        const std::optional<NamedPoint> point = decider->sample_point();
        if (!point) continue;
        NamedNumbers& inputs = points.emplace_back();
        for (const auto& [name, value] : *point)
            inputs[name] = value.exact ? static_cast<long double>(value.exact->get_d()) : std::stold(value.decimal);
    }
    return points;
}

GenericSpan::GenericSpan(Graph& graph, const std::vector<NamedNumbers>& points)
    : graph_(&graph), points_(&points), spans_(points.size(), OrthonormalSpan(dependent_vector))
{
}

bool GenericSpan::add(const std::vector<NodeId>& vector)
{
    std::size_t rank = size_;
    for (std::size_t k = 0; k < points_->size(); ++k) {
        const std::vector<long double> numbers = evaluate<long double>(*graph_, vector, (*points_)[k]);
        if (!std::ranges::all_of(numbers, [](long double each) { return std::isfinite(each); })) continue;
        (void)spans_[k].add(numbers);
        rank = std::max(rank, spans_[k].size());
    }
    const bool is_new = rank > size_;
    size_ = rank;
    return is_new;
}

bool GenericSpan::add_differential(NodeId f, const std::vector<NodeId>& z)
{
    return add(gradient(*graph_, f, z));
}

} // namespace lagen
