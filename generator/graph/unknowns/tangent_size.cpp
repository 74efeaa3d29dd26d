// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/unknowns/tangent_size.hpp"

#include <bit>

namespace lagen {

namespace {

/// Operations on derivatives. Chains of eight links in joint angles are just above both bounds: by columns their
/// Jacobian has less than half the text, in registers of two columns it takes 1.2 times as long to evaluate and in
/// registers of eight 0.8 times. Of sixteen links the text is a seventh, and the times are 1.5 and 0.5. Of the models
/// of models/ none is above them; the arm of docs/cookbook is in Hamilton's form, where it takes 0.6 of the time.
constexpr std::size_t shortest_by_columns = 5'000;
constexpr std::size_t least_ratio = 8;

} // namespace

InputSets::InputSets(const Graph& graph, std::span<const NodeId> roots, std::span<const NodeId> inputs)
    : width_((inputs.size() + bits - 1) / bits), nodes_(reachable(graph, roots)), sets_(graph.size() * width_, 0)
{
    for (std::size_t k = 0; k < inputs.size(); ++k)
        sets_[inputs[k] * width_ + k / bits] |= std::uint64_t{1} << (k % bits);
    update(graph);
}

void InputSets::join(NodeId id, NodeId other)
{
    for (std::size_t k = 0; k < width_; ++k) sets_[id * width_ + k] |= sets_[other * width_ + k];
}

void InputSets::update(const Graph& graph)
{
    for (const NodeId id : nodes_)
        for (const NodeId operand : graph.operands(id)) join(id, operand);
}

std::size_t InputSets::count(NodeId id) const
{
    std::size_t sum = 0;
    for (std::size_t k = 0; k < width_; ++k) sum += static_cast<std::size_t>(std::popcount(words(id)[k]));
    return sum;
}

bool is_made_by_columns(const Graph& graph, std::span<const NodeId> outputs, std::span<const NodeId> inputs,
                        std::span<const ImplicitBlock> blocks)
{
    std::vector<NodeId> roots(outputs.begin(), outputs.end());
    for (const ImplicitBlock& block : blocks)
        for (const auto* nodes : {&block.unknowns, &block.residuals})
            roots.insert(roots.end(), nodes->begin(), nodes->end());
    InputSets sets(graph, roots, inputs);
    for (const ImplicitBlock& block : blocks) {
        for (const NodeId unknown : block.unknowns)
            for (const NodeId residual : block.residuals) sets.join(unknown, residual);
        sets.update(graph);
    }
    std::size_t by_entries = 0, along_one = 0; // operations
    for (const NodeId id : reachable(graph, roots)) {
        const std::size_t count = sets.count(id);
        by_entries += count;
        along_one += count > 0 ? 1 : 0;
    }
    return by_entries > shortest_by_columns && by_entries > least_ratio * along_one;
}

} // namespace lagen
