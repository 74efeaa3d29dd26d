// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/kernel_vectors.hpp"

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

void append_vectors(std::vector<KernelVector>& vectors, Graph& graph, const FibreHessian& hessian, const Block& block,
                    const ZeroDecider& decider, const Order& order)
{
    const std::vector<NodeId> entries = hessian.submatrix(block);
    const FunctionMatrix W(graph, entries, block.size(), block.size());
    std::optional<Minor> minor = W.largest_minor(decider);
    if (!minor) return;
    minor->columns = minor->rows; // W is symmetric
    for (std::size_t j = 0; j < block.size(); ++j) {
        if (std::ranges::find(minor->rows, j) != minor->rows.end()) continue;
        const std::vector<NodeId> k = W.kernel_vector(*minor, j);
        if (!W.maps_to_zero(k, decider)) continue;
        if (auto vector = readable_vector(graph, block, k, order, decider)) vectors.push_back(std::move(*vector));
    }
}

} // namespace

std::optional<KernelVector> readable_vector(Graph& graph, const std::vector<std::size_t>& places,
                                            const std::vector<NodeId>& k, const Order& order,
                                            const ZeroDecider& decider)
{
    KernelVector vector;
    for (std::size_t b = 0; b < places.size(); ++b) {
        const Decision decision = decider.decide(k[b]);
        if (decision.status == ProofStatus::proved) continue;
        vector.emplace_back(places[b], tree_of(graph, k[b], decision, order, decider));
        if (vector.back().second == nullptr) return {};
    }
    return vector;
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
