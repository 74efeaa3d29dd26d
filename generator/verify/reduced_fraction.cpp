// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/reduced_fraction.hpp"

#include "graph/core/lower.hpp"

namespace lagen {

namespace {

/// By GiNaC; null where it does not have a function of the tree, meets a pole, or the fraction is long.
Tree reduced_tree(const Tree& tree, const Order& order)
{
    try {
        return with_ginac("no reduced fraction", [&]() -> Tree {
            SymbolTable symbols;
            const GiNaC::ex given = to_ginac(tree, symbols);
            return has_short_fraction(given) ? shortest_form(given.normal(), symbols, order) : nullptr;
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
    if (decider.status(difference) != ProofStatus::proved) return std::nullopt;
    return reduced;
}

} // namespace lagen
