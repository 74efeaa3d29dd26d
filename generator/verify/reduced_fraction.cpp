// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/reduced_fraction.hpp"

#include "graph/core/lower.hpp"

namespace lagen {
namespace {

/// What is longer takes its time, and has no short factors.
constexpr std::size_t longest_product = 800;

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

bool is_negative(const TreeNode& exponent)
{
    const bool minus = exponent.kind == TreeKind::negate && exponent.arguments[0]->kind == TreeKind::number;
    return minus || (exponent.kind == TreeKind::number && exponent.number < 0);
}

/// The factors of the numerator, without their exponents; numbers are none.
void append_factors(std::vector<Tree>& factors, const Tree& tree)
{
    switch (tree->kind) {
    case TreeKind::number:
    case TreeKind::pi: return;
    case TreeKind::negate:
    case TreeKind::divide: return append_factors(factors, tree->arguments[0]);
    case TreeKind::multiply:
        for (const Tree& factor : tree->arguments) append_factors(factors, factor);
        return;
    case TreeKind::power: {
        const Tree& exponent = tree->arguments[1];
        if (is_negative(*exponent)) return; // of a denominator
        if (exponent->kind == TreeKind::number) return append_factors(factors, tree->arguments[0]);
        break;
    }
    default: break;
    }
    factors.push_back(tree);
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

std::optional<std::vector<Tree>> factors_of(Graph& graph, NodeId node, const Order& order, const ZeroDecider& decider)
{
    if (to_text(graph, node, longest_product).size() > longest_product) return std::nullopt;
    std::vector<Tree> factors;
    const Tree tree = to_tree(graph, node);
    append_factors(factors, reduced_fraction(graph, node, tree, order, decider).value_or(tree));
    return factors;
}

} // namespace lagen
