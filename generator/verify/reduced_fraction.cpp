// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/reduced_fraction.hpp"

#include "graph/lower.hpp"

namespace lagen {

Order writing_order(const Graph& graph, const ProofSetting& setting)
{
    Order order;
    for (const NodeId input : setting.parameters) order.parameters.push_back(graph.input_name(input));
    for (const NodeId input : setting.variables) order.variables.push_back(graph.input_name(input));
    return order;
}

std::optional<Tree> reduced_fraction(Graph& graph, NodeId node, const Tree& tree, const Order& order,
                                     const ZeroDecider& decider)
{
    try {
        SymbolTable symbols;
        const Tree reduced = shortest_form(to_ginac(tree, symbols).normal(), symbols, order);
        const NodeId difference = graph.subtract(Lowering(graph)(reduced), node);
        if (decider.decide(difference).status == ProofStatus::proved) return reduced;
    } catch (const std::exception&) { // a function that GiNaC does not have, or a pole where it evaluates
    }
    return std::nullopt;
}

} // namespace lagen
