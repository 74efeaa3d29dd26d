// SPDX-License-Identifier: GPL-2.0-or-later
/// Operation counts of a set of outputs.
#include "graph/core/operators.hpp"
#include "graph/core/schedule.hpp"
#include "graph/simplify/simplify.hpp"

#include <algorithm>
#include <functional>
#include <set>

namespace lagen {

OperationCount count_operations(const Graph& graph, std::span<const NodeId> roots)
{
    OperationCount count;
    std::set<NodeId> angles;    // sin and cos of one angle are one call
    std::set<NodeId> arguments; // and so are the Stumpff functions of one argument
    for (const NodeId id : reachable(graph, roots)) {
        const Op op = graph.op(id);
        if ((op == Op::sin || op == Op::cos) && !angles.insert(graph.operands(id)[0]).second) {
            count.weight += operation_weight(graph, id) / 2; // glibc: sin 78, cos 72, sincos 122 instructions
            continue;
        }
        if (op == Op::stumpff && !arguments.insert(graph.operands(id)[0]).second) {
            count.weight += 4; // one step of the recurrence
            continue;
        }
        count.weight += operation_weight(graph, id);
        switch (kind_of(op)) {
        case OpKind::leaf: break;
        case OpKind::sum: ++count.additions; break;
        case OpKind::product: ++count.multiplications; break;
        case OpKind::quotient: ++count.divisions; break;
        case OpKind::power: {
            const std::int64_t n = static_cast<std::int32_t>(graph.payload(id));
            count.multiplications += static_cast<std::size_t>(power_multiplications(n < 0 ? -n : n));
            if (n < 0) ++count.divisions;
            break;
        }
        case OpKind::system: count.solves += op == Op::solve ? 1 : 0; break;
        case OpKind::function:
        case OpKind::comparison:
        case OpKind::choice: ++count.functions;
        }
    }
    return count;
}

std::size_t expanded_terms(const Graph& graph, NodeId node, std::size_t most)
{
    const NodeId roots[] = {node};
    std::vector<std::size_t> terms(std::size_t{node} + 1, 1);
    for (const NodeId id : reachable(graph, roots)) {
        const auto of = [&](std::size_t k) { return terms[graph.operands(id)[k]]; };
        std::size_t count = 1;
        switch (kind_of(graph.op(id))) {
        case OpKind::sum:
            count = 0;
            for (const NodeId operand : graph.operands(id)) count += terms[operand];
            break;
        case OpKind::quotient: count = of(0); break;
        case OpKind::product: count = of(0) * of(1); break; // both at most `most`
        case OpKind::power:
            for (std::int32_t k = 0; k < std::min(static_cast<std::int32_t>(graph.payload(id)), 8) && count < most; ++k)
                count *= of(0);
            break;
        case OpKind::leaf:
        case OpKind::function:
        case OpKind::comparison:
        case OpKind::choice:
        case OpKind::system: break;
        }
        terms[id] = std::min(count, most);
    }
    return terms[node];
}

// The names of the stages of `simplify`, and the terms that cost most.
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
