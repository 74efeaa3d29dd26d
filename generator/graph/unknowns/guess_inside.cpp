// SPDX-License-Identifier: GPL-2.0-or-later
/// Where Newton's method starts: points of sets of unknowns that are given by conditions f > 0.
#include "graph/calculus/differentiate.hpp"
#include "graph/unknowns/implicit.hpp"

#include <algorithm>

namespace lagen {

namespace {

/// A condition f > 0 with its slopes and second derivatives over the unknowns that it holds.
struct Condition {
    std::vector<std::size_t> places; ///< of its unknowns
    NodeId at_zero = 0;              ///< f where they are 0
    std::vector<NodeId> slopes;      ///< there
    std::vector<NodeId> curvature;   ///< constant in the unknowns; else empty
};

Condition condition_of(Graph& graph, NodeId f, std::span<const NodeId> unknowns)
{
    Condition result;
    std::vector<NodeId> z;
    std::vector<std::pair<NodeId, NodeId>> zeros;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
        if (depends_on(graph, unknowns.subspan(k, 1))[f]) {
            result.places.push_back(k);
            z.push_back(unknowns[k]);
            zeros.emplace_back(unknowns[k], graph.constant(0));
        }
    const NodeId outputs[] = {f};
    result.slopes = joined_rows(jacobian(graph, outputs, z));
    const std::vector<NodeId> curvature = joined_rows(jacobian(graph, result.slopes, z));
    if (!depends_on_any(graph, curvature, z)) result.curvature = curvature;
    result.slopes.push_back(f);
    result.slopes = substitute(graph, result.slopes, zeros);
    result.at_zero = result.slopes.back();
    result.slopes.pop_back();
    return result;
}

bool vanish(const Graph& graph, const std::vector<NodeId>& nodes)
{
    return std::ranges::all_of(nodes, [&](NodeId node) { return graph.is_zero(node); });
}

/// Where f is largest, or, where it is affine, f = 1; 0 where f > 0 there. Empty where f is neither.
std::vector<NodeId> point_of(Graph& graph, const Condition& f)
{
    if (f.curvature.empty()) return {};
    const NodeId zero = graph.constant(0);
    std::vector<NodeId> point;
    if (vanish(graph, f.curvature)) {
        NodeId square = zero;
        for (const NodeId a : f.slopes) square = graph.add(square, graph.power(a, 2));
        const NodeId share = graph.divide(graph.subtract(graph.constant(1), f.at_zero), square);
        for (const NodeId a : f.slopes) point.push_back(graph.multiply(a, share));
    } else {
        if (vanish(graph, f.slopes)) return std::vector<NodeId>(f.places.size(), zero); // largest at 0
        std::vector<NodeId> right = f.slopes;
        for (NodeId& entry : right) entry = graph.negate(entry);
        point = graph.solve(f.curvature, right, MatrixStructure::symmetric);
    }
    const NodeId inside = graph.apply(Op::greater, f.at_zero, zero);
    for (NodeId& entry : point) entry = graph.select(inside, zero, entry);
    return point;
}

/// Of conditions a z + b > 0 on one unknown, a a number: the middle of their interval, or 1 from its end.
std::optional<NodeId> middle_of(Graph& graph, const std::vector<const Condition*>& conditions)
{
    std::optional<NodeId> lower, upper;
    for (const Condition* each : conditions) {
        if (each->places.size() != 1 || each->curvature.empty() || !vanish(graph, each->curvature)) return std::nullopt;
        const NodeId a = each->slopes[0];
        if (!graph.is_constant(a) || graph.is_zero(a)) return std::nullopt;
        const bool is_lower = graph.value(a) > 0;
        const NodeId end = graph.negate(graph.divide(each->at_zero, a));
        std::optional<NodeId>& bound = is_lower ? lower : upper;
        bound = bound ? graph.apply(is_lower ? Op::maximum : Op::minimum, *bound, end) : end;
    }
    const NodeId one = graph.constant(1);
    if (!upper) return graph.add(*lower, one);
    if (!lower) return graph.subtract(*upper, one);
    return graph.divide(graph.add(*lower, *upper), graph.constant(2));
}

} // namespace

std::vector<NodeId> guess_inside(Graph& graph, std::span<const NodeId> inside, std::span<const NodeId> unknowns,
                                 std::span<const Rational> start)
{
    std::vector<NodeId> guess(unknowns.size(), graph.constant(0));
    for (std::size_t k = 0; k < start.size(); ++k) guess[k] = graph.constant(start[k]);
    std::vector<Condition> conditions;
    for (const NodeId f : inside) conditions.push_back(condition_of(graph, f, unknowns));
    for (const Condition& f : conditions) {
        std::vector<const Condition*> meeting; // that share unknowns with f, itself included
        for (const Condition& other : conditions)
            if (std::ranges::any_of(other.places, [&](std::size_t k) { return std::ranges::count(f.places, k) > 0; }))
                meeting.push_back(&other);
        if (meeting.size() > 1) {
            if (f.places.size() != 1) continue;
            if (const auto middle = middle_of(graph, meeting)) guess[f.places[0]] = *middle;
            continue;
        }
        const std::vector<NodeId> point = point_of(graph, f);
        for (std::size_t k = 0; k < point.size(); ++k) guess[f.places[k]] = point[k];
    }
    return guess;
}

} // namespace lagen
