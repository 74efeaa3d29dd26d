// SPDX-License-Identifier: GPL-2.0-or-later
/// Use counts and the depth-first evaluation order: a temporary is computed just before its first use.
#include "graph/core/schedule.hpp"

#include "graph/core/operators.hpp"

namespace lagen {
namespace {

bool is_leaf(const Graph& graph, NodeId id)
{
    return operator_of(graph.op(id)).notation == Notation::leaf;
}

/// Which reachable nodes get a name.
std::vector<bool> named_nodes(const Graph& graph, const std::vector<NodeId>& nodes,
                              const std::vector<std::uint32_t>& uses)
{
    std::vector<bool> named(graph.size(), false);
    for (const NodeId id : nodes) {
        const Op op = graph.op(id);
        const bool block = op == Op::factor || op == Op::solve;
        if (block) named[id] = true;
        if (block)
            for (const NodeId operand : graph.operands(id)) named[operand] = true;
        if (uses[id] > 1) named[id] = true;
    }
    for (const NodeId id : nodes) {
        const Op op = graph.op(id);
        const bool sign = op == Op::negate && is_leaf(graph, graph.operands(id)[0]);
        if (is_leaf(graph, id) || op == Op::component || sign) named[id] = false;
    }
    return named;
}

} // namespace

Schedule schedule(const Graph& graph, std::span<const NodeId> outputs)
{
    struct Visit {
        NodeId node;
        std::size_t next;
    };
    Schedule result;
    result.uses.assign(graph.size(), 0);
    const auto nodes = reachable(graph, outputs);
    for (const NodeId id : nodes)
        for (const NodeId operand : graph.operands(id)) ++result.uses[operand];
    for (const NodeId output : outputs) ++result.uses[output];
    const auto named = named_nodes(graph, nodes, result.uses);
    std::vector<bool> done(graph.size(), false);
    std::vector<Visit> stack;
    for (const NodeId output : outputs) {
        stack.push_back({output, 0});
        while (!stack.empty()) {
            Visit& visit = stack.back();
            const NodeId id = visit.node;
            if (!done[id] && visit.next < graph.operands(id).size()) {
                stack.push_back({graph.operands(id)[visit.next++], 0});
                continue;
            }
            if (!done[id] && named[id]) result.temporaries.push_back(id);
            done[id] = true;
            stack.pop_back();
        }
    }
    return result;
}

} // namespace lagen
