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

} // namespace lagen
