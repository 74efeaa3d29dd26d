// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/reduced_fraction.hpp"

#include "graph/lower.hpp"

namespace lagen {

namespace {

/// By GiNaC; null where it does not have a function of the tree, or meets a pole.
Tree reduced_tree(const Tree& tree, const Order& order)
{
    try {
        return with_ginac("no reduced fraction", [&] {
            SymbolTable symbols;
            return shortest_form(to_ginac(tree, symbols).normal(), symbols, order);
        });
    } catch (const MathematicsError&) {
        return nullptr;
    }
}

} // namespace

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
    const Tree reduced = reduced_tree(tree, order);
    if (reduced == nullptr) return std::nullopt;
    const NodeId difference = graph.subtract(Lowering(graph)(reduced), node);
    if (decider.decide(difference).status != ProofStatus::proved) return std::nullopt;
    return reduced;
}

} // namespace lagen
