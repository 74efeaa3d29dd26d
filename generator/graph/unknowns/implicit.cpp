// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/unknowns/implicit.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/limits.hpp"
#include "graph/core/operators.hpp"

#include <algorithm>

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

} // namespace lagen
