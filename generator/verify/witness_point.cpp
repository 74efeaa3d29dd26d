// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/witness_point.hpp"

#include <algorithm>

namespace lagen {
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

WitnessPoint::WitnessPoint(Graph& graph, const NamedPoint& point) : graph_(graph)
{
    for (const auto& [name, value] : point) {
        const NodeId input = graph.input(name);
        if (value.exact) exact_.emplace(input, *value.exact);
        balls_.emplace(input, value.exact ? proof::Ball(*value.exact, precision) : enclosure(value));
    }
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

std::optional<Rational> WitnessPoint::exactly(NodeId node)
{
    if (graph_.is_constant(node)) return graph_.value(node);
    const proof::Evaluation evaluation(graph_, {node});
    effort_ += evaluation.size() + 1;
    const auto& inputs = evaluation.inputs();
    if (!std::all_of(inputs.begin(), inputs.end(), [&](NodeId input) { return exact_.contains(input); }))
        return std::nullopt;
    const auto values = evaluation.exactly(exact_);
    if (!values) return std::nullopt;
    return (*values)[0];
}

} // namespace lagen
