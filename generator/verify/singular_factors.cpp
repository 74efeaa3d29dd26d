// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/singular_factors.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// Determinants that are longer take their time, and have no short factors.
constexpr std::size_t longest_determinant = 800;
constexpr std::size_t longest_factor = 80;

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

std::optional<std::vector<Tree>> factors_of(Graph& graph, NodeId node, const Order& order, const ZeroDecider& decider)
{
    if (to_text(graph, node, longest_determinant).size() > longest_determinant) return std::nullopt;
    std::vector<Tree> factors;
    const Tree tree = to_tree(graph, node);
    append_factors(factors, reduced_fraction(graph, node, tree, order, decider).value_or(tree));
    return factors;
}

std::vector<std::string> singular_factors(Graph& graph, const ProofSetting& setting, const ZeroDecider& valued,
                                          const std::vector<std::pair<NodeId, NodeId>>& defaults,
                                          const std::vector<NodeId>& determinants)
{
    const Order order = writing_order(graph, setting);
    const ZeroDecider decider(graph, setting, valued.budget());
    std::vector<std::string> texts;
    for (const NodeId determinant : determinants) {
        const auto factors = factors_of(graph, determinant, order, decider);
        if (!factors) return {};
        for (const Tree& factor : *factors) {
            const std::vector<NodeId> node = {Lowering(graph)(factor)};
            const auto there = substitute_where_defined(graph, node, defaults);
            if (there && valued.proves_nonzero((*there)[0])) continue;
            const std::string text = to_text(factor);
            if (text.size() > longest_factor) return {};
            if (std::ranges::find(texts, text) == texts.end()) texts.push_back(text);
        }
    }
    return texts;
}

} // namespace lagen
