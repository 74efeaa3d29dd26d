// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/calculus/substitute.hpp"
#include "graph/series/taylor.hpp"

namespace lagen {

std::vector<NodeId> with_joined_factors(Graph& graph, std::span<const NodeId> functions, std::span<const NodeId> moving)
{
    struct Product {
        NodeId factor, core;
    };
    const std::vector<bool> moves = depends_on(graph, moving);
    const NodeId one = graph.constant(1);
    std::vector<Product> products(moves.size());
    Rebuilder map(graph, moves.size());
    for (const NodeId id : reachable(graph, functions)) {
        const Op op = graph.op(id);
        const bool splits = moves[id] && (op == Op::negate || op == Op::multiply || op == Op::divide);
        if (!splits) {
            map.rebuild(id);
            if (op != Op::factor && op != Op::solve)
                products[id] = moves[id] ? Product{one, map[id]} : Product{map[id], one};
            continue;
        }
        const Product a = products[graph.operands(id)[0]], b = products[graph.operands(id).back()];
        const auto joined = [&](NodeId x, NodeId y) {
            return op == Op::multiply ? graph.multiply(x, y) : graph.divide(x, y);
        };
        if (op == Op::negate)
            products[id] = {graph.negate(a.factor), a.core};
        else
            products[id] = {joined(a.factor, b.factor), joined(a.core, b.core)};
        map.set(id, graph.multiply(products[id].factor, products[id].core));
    }
    std::vector<NodeId> result;
    for (const NodeId function : functions) result.push_back(map[function]);
    return result;
}

} // namespace lagen
