// SPDX-License-Identifier: GPL-2.0-or-later
/// How long derivatives become, before any is made: from the structure alone.
#pragma once

#include "graph/unknowns/implicit.hpp"

namespace lagen {

/// By node: which of some inputs it depends on.
class InputSets {
  public:
    InputSets(const Graph& graph, std::span<const NodeId> roots, std::span<const NodeId> inputs);

    /// Does `id`, which the roots depend on, depend on inputs[k]?
    [[nodiscard]] bool holds(NodeId id, std::size_t k) const { return (words(id)[k / bits] >> (k % bits) & 1U) != 0; }
    [[nodiscard]] std::size_t count(NodeId id) const;
    /// From now on `id` depends on what `other` depends on. Nodes behind it follow with update().
    void join(NodeId id, NodeId other);
    void update(const Graph& graph);

  private:
    static constexpr std::size_t bits = 64;
    [[nodiscard]] const std::uint64_t* words(NodeId id) const { return &sets_[id * width_]; }

    std::size_t width_;
    std::vector<NodeId> nodes_;
    std::vector<std::uint64_t> sets_;
};

/// True where the Jacobian of `outputs`, entry by entry, is many times as long as one directional derivative: where
/// single inputs are in most of long outputs, as in chains.
[[nodiscard]] bool is_made_by_columns(const Graph& graph, std::span<const NodeId> outputs,
                                      std::span<const NodeId> inputs, std::span<const ImplicitBlock> blocks);

} // namespace lagen
