// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/unknowns/implicit.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/limits.hpp"
#include "graph/core/operators.hpp"

#include <algorithm>
#include <map>

namespace lagen {

namespace {

using Seeds = std::vector<std::pair<NodeId, NodeId>>; ///< inputs, each with a node for it

/// The tangents of the unknowns of one block along several lists of seeds, which are extended by them.
void extend(Graph& graph, const ImplicitBlock& block, std::vector<Seeds>& directions)
{
    std::vector<std::vector<NodeId>> columns;
    for (const Seeds& seeds : directions) {
        columns.push_back(directional(graph, block.residuals, seeds));
        for (NodeId& entry : columns.back()) entry = graph.negate(entry);
    }
    const std::vector<std::vector<NodeId>> tangents = graph.solve(block.jacobian, columns, block.structure);
    for (std::size_t k = 0; k < directions.size(); ++k)
        for (std::size_t i = 0; i < block.unknowns.size(); ++i)
            directions[k].emplace_back(block.unknowns[i], tangents[k][i]);
}

} // namespace

ImplicitBlock implicit_block(Graph& graph, std::string name, std::string documentation, std::vector<NodeId> unknowns,
                             std::vector<NodeId> residuals, std::vector<NodeId> guess, MatrixStructure structure)
{
    ImplicitBlock block{std::move(name),
                        std::move(documentation),
                        std::move(unknowns),
                        std::move(residuals),
                        {},
                        std::move(guess),
                        {},
                        {},
                        structure,
                        {}};
    block.jacobian = joined_rows(jacobian(graph, block.residuals, block.unknowns));
    block.sizes = rounding_sizes(graph, block.residuals);
    return block;
}

std::vector<NodeId> positive_operands(Graph& graph, NodeId function, std::span<const NodeId> unknowns)
{
    const std::vector<bool> depends = depends_on(graph, unknowns);
    std::vector<NodeId> result;
    const NodeId roots[] = {function};
    for (const NodeId node : certainly_needed(graph, roots)) {
        if (smooth_where(graph, node) != Sense::positive || !depends[graph.operands(node)[0]]) continue;
        const NodeId positive = condition_of(graph, node);
        if (std::ranges::count(result, positive) == 0) result.push_back(positive);
    }
    return result;
}

ImplicitBlock gradient_block(Graph& graph, std::string name, std::string documentation, std::vector<NodeId> unknowns,
                             std::vector<NodeId> residuals, NodeId function, std::span<const Rational> start)
{
    std::vector<NodeId> inside = positive_operands(graph, function, unknowns);
    std::vector<NodeId> guess = guess_inside(graph, inside, unknowns, start);
    ImplicitBlock block = implicit_block(graph, std::move(name), std::move(documentation), std::move(unknowns),
                                         std::move(residuals), std::move(guess), MatrixStructure::symmetric);
    block.inside = std::move(inside);
    return block;
}

Seeds seeds_through(Graph& graph, std::span<const ImplicitBlock> blocks, Seeds seeds)
{
    std::vector<Seeds> directions{std::move(seeds)};
    for (const ImplicitBlock& block : blocks) extend(graph, block, directions);
    return directions.front();
}

std::vector<std::vector<NodeId>> jacobian_through(Graph& graph, std::span<const NodeId> outputs,
                                                  std::span<const NodeId> inputs, std::span<const ImplicitBlock> blocks)
{
    if (blocks.empty()) return jacobian_with_limits(graph, outputs, inputs);
    std::vector<Seeds> directions;
    for (const NodeId input : inputs) directions.push_back({{input, graph.constant(1)}});
    for (const ImplicitBlock& block : blocks) extend(graph, block, directions);
    std::vector<std::vector<NodeId>> result(outputs.size(), std::vector<NodeId>(inputs.size()));
    for (std::size_t column = 0; column < inputs.size(); ++column) {
        const std::vector<NodeId> derivative = directional_with_limits(graph, outputs, directions[column], inputs);
        for (std::size_t row = 0; row < outputs.size(); ++row) result[row][column] = derivative[row];
    }
    return result;
}

// Where Newton's method starts: points of sets of unknowns that are given by conditions f > 0.

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

// What rounding does to equations as they are written, to first order [Higham 2002, chapter 3].

namespace {

/// The rounding error of one operation in units of epsilon, from those of its operands.
NodeId rounding_of(Graph& graph, NodeId node, const std::map<NodeId, NodeId>& sizes)
{
    const std::vector<NodeId> operands(graph.operands(node).begin(), graph.operands(node).end());
    const NodeId zero = graph.constant(0);
    if (operands.empty()) return zero;
    const auto size = [&](std::size_t k) { return sizes.at(operands[k]); };
    const auto absolute = [&](NodeId value) { return graph.apply(Op::abs, value); };
    NodeId inherited = zero;
    const Op op = graph.op(node);
    switch (kind_of(op)) {
    case OpKind::leaf: return zero;
    case OpKind::choice: return graph.select(operands[0], size(1), size(2));
    case OpKind::sum:
        if (operands.size() == 1) return size(0);
        inherited = graph.add(size(0), size(1));
        break;
    case OpKind::quotient:
        inherited = size(0);
        if (!graph.is_zero(size(1))) inherited = graph.add(inherited, graph.multiply(size(1), absolute(node)));
        if (!graph.is_zero(inherited)) inherited = graph.divide(inherited, absolute(operands[1]));
        break;
    case OpKind::system: // the sum of all sizes; factor and solve have no value of their own
        for (std::size_t k = 0; k < operands.size(); ++k) inherited = graph.add(inherited, size(k));
        if (op != Op::component) return inherited;
        break;
    case OpKind::product:
    case OpKind::power:
    case OpKind::function:
    case OpKind::comparison:
        for (std::size_t k = 0; k < operands.size(); ++k)
            if (!graph.is_zero(size(k)))
                inherited = graph.add(inherited, graph.multiply(size(k), slope_bound(graph, node, k)));
    }
    return graph.add(inherited, absolute(node));
}

} // namespace

std::vector<NodeId> rounding_sizes(Graph& graph, std::span<const NodeId> residuals)
{
    std::map<NodeId, NodeId> sizes;
    for (const NodeId node : reachable(graph, residuals)) sizes[node] = rounding_of(graph, node, sizes);
    std::vector<NodeId> result;
    for (const NodeId residual : residuals) result.push_back(sizes.at(residual));
    return result;
}

} // namespace lagen
