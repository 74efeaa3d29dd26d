// SPDX-License-Identifier: GPL-2.0-or-later
/// The memory of decisions: hash-consing makes equal residuals the same node.
#include "verify/judge.hpp"

#include <algorithm>

namespace lagen {

Judge::Judge(const Graph& graph, ProofSetting setting, const ProofBudget& budget)
    : graph_(graph), setting_(std::move(setting)), decider_(std::make_unique<ZeroDecider>(graph, setting_, budget))
{
}

Decision Judge::decide_anew(NodeId residual) const
{
    Decision decision = decider_->decide(residual);
    show_concerned(graph_, setting_, residual, decision);
    return decision;
}

const Decision& Judge::decide(NodeId residual)
{
    const auto known = decisions_.find(residual);
    if (known != decisions_.end()) return known->second;
    return decisions_.emplace(residual, decide_anew(residual)).first->second;
}

namespace {

constexpr slong precision = 256;

/// All numbers from `lower` to `upper`.
proof::Ball enclosure(const PointValue& value)
{
    const proof::Ball lower(value.lower, precision), upper(value.upper, precision);
    proof::Ball ball;
    arb_union(ball.get(), lower.get(), upper.get(), precision);
    return ball;
}

} // namespace

std::set<std::string> input_names(const Graph& graph, const std::vector<NodeId>& nodes)
{
    std::set<std::string> names;
    for (const NodeId node : reachable(graph, nodes))
        if (graph.op(node) == Op::input) names.insert(graph.input_name(node));
    return names;
}

NamedPoint concerned(const Graph& graph, const ProofSetting& setting, std::set<std::string> names,
                     const NamedPoint& point)
{
    std::vector<std::set<std::string>> ties;
    for (const NodeId constraint : setting.constraints) ties.push_back(input_names(graph, {constraint}));
    for (std::size_t before = 0; before != names.size();) {
        before = names.size();
        for (const std::set<std::string>& tied : ties)
            if (std::ranges::any_of(tied, [&](const std::string& name) { return names.contains(name); }))
                names.insert(tied.begin(), tied.end());
    }
    NamedPoint result;
    for (const auto& entry : point)
        if (names.contains(entry.first)) result.push_back(entry);
    return result;
}

void show_concerned(const Graph& graph, const ProofSetting& setting, NodeId residual, Decision& decision)
{
    if (!decision.witness) return;
    std::set<std::string> names = input_names(graph, {residual});
    if (decision.normal_form) {
        const std::vector<std::string> left = names_in(decision.normal_form); // what cancels is no part of it
        names = {left.begin(), left.end()};
    }
    decision.witness->whole = decision.witness->point;
    decision.witness->point = concerned(graph, setting, std::move(names), decision.witness->whole);
}

WitnessPoint::WitnessPoint(Graph& graph, const NamedPoint& point) : graph_(graph)
{
    for (const auto& [name, value] : point) {
        const NodeId input = graph.input(name);
        balls_.emplace(input, value.exact ? proof::Ball(*value.exact, precision) : enclosure(value));
    }
}

std::vector<proof::Ball> WitnessPoint::enclose(const std::vector<NodeId>& nodes) const
{
    return proof::Evaluation(graph_, nodes).enclose(balls_, precision);
}

bool WitnessPoint::may_vanish(NodeId node)
{
    if (graph_.is_constant(node)) return graph_.is_zero(node);
    const proof::Evaluation evaluation(graph_, {node});
    effort_ += evaluation.size() + 1;
    const auto& inputs = evaluation.inputs();
    if (!std::all_of(inputs.begin(), inputs.end(), [&](NodeId input) { return balls_.contains(input); })) return true;
    return !evaluation.enclose(balls_, precision)[0].excludes_zero();
}

} // namespace lagen
