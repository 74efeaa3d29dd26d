// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/kernel_vectors.hpp"

#include "expression/parse.hpp"
#include "graph/lower.hpp"
#include "proof/print_fraction.hpp"
#include "proof/rational_matrix.hpp"
#include "verify/reduced_fraction.hpp"

#include <algorithm>
#include <bit>

namespace lagen {
namespace {

using Block = std::vector<std::size_t>;

constexpr std::size_t longest_component = 200;

/// Normal forms that take long are not worth a text.
constexpr std::size_t longest_input = 2000;

/// The node as it was built, or its normal form where that is shorter.
Tree shorter_tree(const Graph& graph, NodeId node, const Decision& decision)
{
    Tree tree = to_tree(graph, node);
    if (!proof::is_whole(decision.residual) || decision.residual.size() >= to_text(tree).size()) return tree;
    try {
        return parse_expression(whole_text("<normal form>", decision.residual));
    } catch (const Error&) {
        return tree; // a name that cannot be read back
    }
}

/// The shortest of what was built, its normal form and its reduced fraction; empty where all are too long.
std::string text_of(Graph& graph, NodeId node, const Decision& decision, const Order& order, const ZeroDecider& decider)
{
    const Tree tree = shorter_tree(graph, node, decision);
    std::string text = to_text(tree);
    if (text.size() > longest_input) return "";
    const auto offer = [&](std::string other) {
        if (!other.empty() && other.size() <= text.size()) text = std::move(other);
    };
    if (proof::is_whole(decision.residual)) offer(decision.residual);
    if (const auto reduced = reduced_fraction(graph, node, tree, order, decider)) offer(to_text(*reduced));
    return text.size() <= longest_component ? text : "";
}

/// Whether W k = 0 is proved in the rows of a block.
bool is_in_kernel(Graph& graph, const FibreHessian& hessian, const Block& block, const std::vector<NodeId>& k,
                  const ZeroDecider& decider)
{
    return std::ranges::all_of(block, [&](std::size_t a) {
        std::vector<NodeId> terms;
        for (std::size_t b = 0; b < block.size(); ++b) terms.push_back(graph.multiply(hessian.W(a, block[b]), k[b]));
        return decider.decide(graph.sum(terms)).status == ProofStatus::proved;
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

/// k times the least common denominator of its entries, so that it is defined wherever W is; k itself where that is a
/// number, or takes too long to find.
std::vector<NodeId> without_denominators(Graph& graph, const std::vector<NodeId>& k, const Order& order,
                                         const ZeroDecider& decider)
{
    try {
        SymbolTable symbols;
        GiNaC::exmap functions; // as symbols: lcm knows polynomials alone
        GiNaC::ex common = 1;
        for (const NodeId entry : k) {
            const Tree tree = shorter_tree(graph, entry, decider.decide(entry));
            if (to_text(tree).size() > longest_input) return k;
            const GiNaC::ex denominator = to_ginac(tree, symbols).normal().denom();
            common = GiNaC::lcm(common, denominator.to_polynomial(functions));
        }
        if (GiNaC::is_a<GiNaC::numeric>(common)) return k;
        const NodeId factor = Lowering(graph)(shortest_form(common.subs(functions), symbols, order));
        std::vector<NodeId> multiple;
        for (const NodeId entry : k) multiple.push_back(graph.multiply(factor, entry));
        return multiple;
    } catch (const std::exception&) {
        return k; // a function that GiNaC does not have
    }
}

void append_vectors(std::vector<KernelVector>& vectors, Graph& graph, const FibreHessian& hessian, const Block& block,
                    const ZeroDecider& decider, const Order& order)
{
    const auto minor = nonzero_principal_minor(graph, hessian, block, decider);
    if (!minor) return;
    for (const std::size_t j : block) {
        if (std::ranges::find(*minor, j) != minor->end()) continue;
        std::vector<NodeId> k = kernel_entries(graph, hessian, block, *minor, j);
        if (!is_in_kernel(graph, hessian, block, k, decider)) continue;
        k = without_denominators(graph, k, order, decider);
        KernelVector vector;
        bool readable = true;
        for (std::size_t b = 0; b < block.size(); ++b) {
            const Decision decision = decider.decide(k[b]);
            if (decision.status == ProofStatus::proved) continue;
            vector.emplace_back(block[b], text_of(graph, k[b], decision, order, decider));
            readable = readable && !vector.back().second.empty();
        }
        if (readable) vectors.push_back(std::move(vector));
    }
}

/// Numbers need no proof, and no minors.
bool append_constant_vectors(std::vector<KernelVector>& vectors, const Graph& graph, const FibreHessian& hessian,
                             const Block& block)
{
    std::vector<Rational> entries;
    for (const std::size_t a : block)
        for (const std::size_t b : block) {
            if (!graph.is_constant(hessian.W(a, b))) return false;
            entries.push_back(graph.value(hessian.W(a, b)));
        }
    for (const std::vector<Rational>& k : kernel_of(entries, block.size())) {
        KernelVector vector;
        for (std::size_t b = 0; b < block.size(); ++b)
            if (k[b] != 0) vector.emplace_back(block[b], k[b].get_str());
        vectors.push_back(std::move(vector));
    }
    return true;
}

} // namespace

std::optional<Block> nonzero_principal_minor(Graph& graph, const FibreHessian& hessian, const Block& block,
                                             const ZeroDecider& decider)
{
    for (std::size_t size = block.size(); size > 0; --size)
        for (std::size_t set = 0; set < std::size_t{1} << block.size(); ++set) {
            if (static_cast<std::size_t>(std::popcount(set)) != size) continue;
            Block part;
            for (std::size_t k = 0; k < block.size(); ++k)
                if (set >> k & 1U) part.push_back(block[k]);
            const Decision decision = decider.decide(minor_determinant(graph, hessian, part, part));
            if (decision.status == ProofStatus::refuted) return part;
            if (decision.status == ProofStatus::undecided) return {};
        }
    return Block{};
}

std::vector<KernelVector> kernel_vectors(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider,
                                         const ProofSetting& setting)
{
    const Order order = writing_order(graph, setting);
    std::vector<KernelVector> vectors;
    for (const Block& block : hessian.blocks)
        if (!append_constant_vectors(vectors, graph, hessian, block) && block.size() <= determinant_limit)
            append_vectors(vectors, graph, hessian, block, decider, order);
    return vectors;
}

} // namespace lagen
