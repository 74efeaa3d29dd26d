// SPDX-License-Identifier: GPL-2.0-or-later
/// Determinants reduced and factored by GiNaC, which is believed only where the zero decision confirms it.
#include "geometry/singular_factors.hpp"

#include "graph/differentiate.hpp"
#include "graph/lower.hpp"
#include "symbolic/shortest_form.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// Determinants that are longer take their time, and have no short factors.
constexpr std::size_t longest_determinant = 800;
constexpr std::size_t longest_factor = 80;

/// The names of inputs, parameters before variables.
Order order_in(const Graph& graph, const ProofSetting& setting)
{
    Order order;
    for (const NodeId input : setting.parameters) order.parameters.push_back(graph.input_name(input));
    for (const NodeId input : setting.variables) order.variables.push_back(graph.input_name(input));
    return order;
}

/// The reduced fraction where it is proved to be the same, else the determinant as it is.
Tree reduced_determinant(Graph& graph, NodeId determinant, const Order& order, const ZeroDecider& decider)
{
    const Tree tree = to_tree(graph, determinant);
    try {
        SymbolTable symbols;
        const Tree reduced = shortest_form(to_ginac(tree, symbols).normal(), symbols, order);
        const NodeId difference = graph.subtract(Lowering(graph)(reduced), determinant);
        return decider.decide(difference).status == ProofStatus::proved ? reduced : tree;
    } catch (const std::exception&) {
        return tree; // a function that GiNaC does not have, or a pole where it evaluates
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

std::vector<std::string> singular_factors(Graph& graph, const ProofSetting& setting, const ZeroDecider& valued,
                                          const std::vector<std::pair<NodeId, NodeId>>& defaults,
                                          const std::vector<NodeId>& determinants)
{
    const Order order = order_in(graph, setting);
    const ZeroDecider decider(graph, setting, valued.budget());
    std::vector<std::string> texts;
    for (const NodeId determinant : determinants) {
        if (to_text(graph, determinant, longest_determinant).size() > longest_determinant) return {};
        std::vector<Tree> factors;
        append_factors(factors, reduced_determinant(graph, determinant, order, decider));
        for (const Tree& factor : factors) {
            const std::vector<NodeId> node = {Lowering(graph)(factor)};
            if (valued.proves_nonzero(substitute(graph, node, defaults)[0])) continue;
            const std::string text = to_text(factor);
            if (text.size() > longest_factor) return {};
            if (std::ranges::find(texts, text) == texts.end()) texts.push_back(text);
        }
    }
    return texts;
}

} // namespace lagen
