// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/kernel_vectors.hpp"

#include "graph/calculus/places.hpp"
#include "graph/core/lower.hpp"
#include "verify/reduced_fraction.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Block = std::vector<std::size_t>;

constexpr std::size_t longest_component = 200;

/// Normal forms that take long are not worth a text.
constexpr std::size_t longest_input = 2000;

/// The later one where they are equally long.
Tree shorter(const Tree& tree, const Tree& other)
{
    return to_text(other).size() <= to_text(tree).size() ? other : tree;
}

/// The node as it was built, or its normal form.
Tree shorter_tree(const Graph& graph, NodeId node, const Decision& decision)
{
    const Tree tree = to_tree(graph, node);
    return decision.normal_form ? shorter(tree, decision.normal_form) : tree;
}

/// The shortest of what was built, its normal form and its reduced fraction; null where all are too long.
Tree tree_of(Graph& graph, NodeId node, const Decision& decision, const Order& order, const ZeroDecider& decider)
{
    Tree tree = shorter_tree(graph, node, decision);
    if (to_text(tree).size() > longest_input) return nullptr;
    if (const auto reduced = reduced_fraction(graph, node, tree, order, decider)) tree = shorter(tree, *reduced);
    return to_text(tree).size() <= longest_component ? tree : nullptr;
}

/// True where W k = 0 is proved in the rows of a block.
bool is_in_kernel(Graph& graph, const FibreHessian& hessian, const Block& block, const std::vector<NodeId>& k,
                  const ZeroDecider& decider)
{
    return std::ranges::all_of(block, [&](std::size_t a) {
        std::vector<NodeId> terms;
        for (std::size_t b = 0; b < block.size(); ++b) terms.push_back(graph.multiply(hessian.W(a, block[b]), k[b]));
        return decider.status(graph.sum(terms)) == ProofStatus::proved;
    });
}

/// The entries k of a vector over a block, by Cramer's rule.
std::vector<NodeId> kernel_entries(Graph& graph, const FibreHessian& hessian, const Block& block, const Block& minor,
                                   std::size_t j)
{
    std::vector<NodeId> k(block.size(), graph.constant(0));
    std::vector<NodeId> right;
    for (const std::size_t a : minor) right.push_back(graph.negate(hessian.W(a, j)));
    const NodeId determinant = minor.empty() ? graph.constant(1) : minor_determinant(graph, hessian, minor, minor);
    for (std::size_t b = 0; b < block.size(); ++b) {
        const auto place = std::ranges::find(minor, block[b]);
        if (block[b] == j) k[b] = graph.constant(1);
        if (place == minor.end()) continue;
        const auto column = static_cast<std::size_t>(place - minor.begin());
        k[b] = graph.divide(minor_determinant(graph, hessian, minor, minor, column, right), determinant);
    }
    return k;
}

/// The least common denominator; null where that is a number, or GiNaC cannot say: it lacks functions, and meets poles.
Tree common_denominator(const std::vector<Tree>& trees, const Order& order)
{
    try {
        return with_ginac("no common denominator", [&]() -> Tree {
            SymbolTable symbols;
            GiNaC::exmap functions; // as symbols: lcm knows polynomials alone
            GiNaC::ex common = 1;
            for (const Tree& tree : trees) {
                const GiNaC::ex fraction = to_ginac(tree, symbols);
                if (!has_short_fraction(fraction)) return nullptr;
                const GiNaC::ex denominator = fraction.normal().denom();
                common = GiNaC::lcm(common, denominator.to_polynomial(functions));
            }
            if (GiNaC::is_a<GiNaC::numeric>(common)) return nullptr;
            return shortest_form(common.subs(functions), symbols, order);
        });
    } catch (const MathematicsError&) {
        return nullptr;
    }
}

/// k times the least common denominator of its entries, so that it is defined wherever W is; k itself where that is a
/// number, or takes too long to find.
std::vector<NodeId> without_denominators(Graph& graph, const std::vector<NodeId>& k, const Order& order,
                                         const ZeroDecider& decider)
{
    std::vector<Tree> trees;
    for (const NodeId entry : k) {
        trees.push_back(shorter_tree(graph, entry, decider.decide(entry)));
        if (to_text(trees.back()).size() > longest_input) return k;
    }
    const Tree common = common_denominator(trees, order);
    if (common == nullptr) return k;
    const NodeId factor = Lowering(graph)(common);
    std::vector<NodeId> multiple;
    for (const NodeId entry : k) multiple.push_back(graph.multiply(factor, entry));
    return multiple;
}

void append_vectors(std::vector<KernelVector>& vectors, Graph& graph, const FibreHessian& hessian, const Block& block,
                    const ZeroDecider& decider, const Order& order)
{
    const auto minor = nonzero_principal_minor(graph, hessian, block, decider);
    if (!minor) return;
    for (const std::size_t j : block) {
        if (std::ranges::find(*minor, j) != minor->end()) continue;
        const std::vector<NodeId> k = kernel_entries(graph, hessian, block, *minor, j);
        if (!is_in_kernel(graph, hessian, block, k, decider)) continue;
        if (auto vector = readable_vector(graph, block, k, order, decider)) vectors.push_back(std::move(*vector));
    }
}

} // namespace

std::optional<KernelVector> readable_vector(Graph& graph, const std::vector<std::size_t>& places,
                                            const std::vector<NodeId>& k, const Order& order,
                                            const ZeroDecider& decider)
{
    const std::vector<NodeId> multiple = without_denominators(graph, k, order, decider);
    KernelVector vector;
    for (std::size_t b = 0; b < places.size(); ++b) {
        const Decision decision = decider.decide(multiple[b]);
        if (decision.status == ProofStatus::proved) continue;
        vector.emplace_back(places[b], tree_of(graph, multiple[b], decision, order, decider));
        if (vector.back().second == nullptr) return {};
    }
    return vector;
}

std::optional<Block> nonzero_principal_minor(Graph& graph, const FibreHessian& hessian, const Block& block,
                                             const ZeroDecider& decider)
{
    for (std::size_t size = block.size(); size > 0; --size) {
        Places chosen = first_places(size);
        do {
            Block part;
            for (const std::size_t k : chosen) part.push_back(block[k]);
            const ProofStatus status = decider.status(minor_determinant(graph, hessian, part, part));
            if (status == ProofStatus::refuted) return part;
            if (status == ProofStatus::undecided) return {};
        } while (next_places(chosen, block.size()));
    }
    return Block{};
}

std::vector<KernelVector> kernel_vectors(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider,
                                         const ProofSetting& setting)
{
    const Order order = writing_order(graph, setting);
    std::vector<KernelVector> vectors;
    for (const Block& block : hessian.blocks)
        if (block.size() <= determinant_limit) append_vectors(vectors, graph, hessian, block, decider, order);
    return vectors;
}

} // namespace lagen
