// SPDX-License-Identifier: GPL-2.0-or-later
/// The names of the stages of `simplify`, and the terms that cost most.
#include "graph/core/operators.hpp"
#include "graph/core/schedule.hpp"
#include "graph/simplify/simplify.hpp"

#include <algorithm>
#include <functional>

namespace lagen {
namespace {

constexpr std::size_t longest_term = 90;

} // namespace

std::vector<CostlyTerm> costliest_terms(const Graph& graph, std::span<const NodeId> outputs, std::size_t count)
{
    const Schedule plan = schedule(graph, outputs);
    std::vector<bool> named(graph.size(), false);
    for (const NodeId id : plan.temporaries) named[id] = true;
    for (const NodeId id : outputs) named[id] = true;
    std::vector<double> weights(graph.size(), 0); // with the unnamed operands
    std::vector<CostlyTerm> terms;
    std::vector<NodeId> nodes;
    for (const NodeId id : reachable(graph, outputs)) {
        weights[id] = operation_weight(graph, id);
        for (const NodeId operand : graph.operands(id))
            if (!named[operand]) weights[id] += weights[operand];
        if (named[id] && weights[id] > 0) nodes.push_back(id);
    }
    std::ranges::stable_sort(nodes, std::greater<>(), [&](NodeId id) { return weights[id]; });
    if (nodes.size() > count) nodes.resize(count);
    for (const NodeId id : nodes) terms.push_back({to_text(graph, id, longest_term), weights[id], plan.uses[id]});
    return terms;
}

const char* to_text(Stage stage)
{
    switch (stage) {
    case Stage::pass: return "one pass";
    case Stage::lightest: return "the lightest form that keeps its digits";
    case Stage::mixed: return "outputs of several forms";
    case Stage::eliminated: return "solved through the terms of a Hessian";
    }
    return "";
}

} // namespace lagen
