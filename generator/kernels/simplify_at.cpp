// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/simplify_at.hpp"

namespace lagen {

std::vector<NodeId> simplify_at(Graph& graph, const std::vector<NodeId*>& places, SimplifyReport* report)
{
    std::vector<NodeId> nodes, divisors;
    for (const NodeId* place : places) nodes.push_back(*place);
    nodes = simplify(graph, nodes, divisors, report);
    for (std::size_t k = 0; k < places.size(); ++k) *places[k] = nodes[k];
    return divisors;
}

void simplify_at(Graph& graph, std::initializer_list<std::vector<NodeId>*> lists)
{
    std::vector<NodeId*> places;
    for (std::vector<NodeId>* list : lists)
        for (NodeId& node : *list) places.push_back(&node);
    simplify_at(graph, places);
}

void simplify_blocks(Graph& graph, std::vector<ImplicitBlock>& blocks)
{
    for (ImplicitBlock& block : blocks) {
        simplify_at(graph, {&block.guess});
        if (block.bracket)
            for (auto* ends : {&block.bracket->lower, &block.bracket->upper})
                for (std::optional<NodeId>& end : *ends)
                    if (end) simplify_at(graph, std::vector<NodeId*>{&*end});
        if (block.angles)
            for (auto* parts : {&block.angles->b, &block.angles->c}) simplify_at(graph, {parts});
        simplify_at(graph, {&block.residuals, &block.jacobian, &block.inside});
        block.sizes = rounding_sizes(graph, block.residuals);
    }
}

} // namespace lagen
