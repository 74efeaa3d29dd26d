// SPDX-License-Identifier: GPL-2.0-or-later
/// One node again on other operands: the step that every rewriting walk shares.
#pragma once

#include "graph/core/graph.hpp"

namespace lagen {

/// Rebuilds nodes in topological order: `map[id]` is the new node of an old scalar node. Solves are rebuilt whole, with
/// their components, when their first component is reached.
class Rebuilder {
  public:
    Rebuilder(Graph& graph, std::size_t size) : graph_(graph), map_(size, none) {}

    void set(NodeId old, NodeId replacement) { map_[old] = replacement; }
    [[nodiscard]] bool has(NodeId old) const { return map_[old] != none; }
    [[nodiscard]] NodeId operator[](NodeId old) const { return map_[old]; }
    /// Maps `old` from its mapped operands, through the constructors of the graph.
    void rebuild(NodeId old);

  private:
    static constexpr NodeId none = UINT32_MAX;
    void rebuild_solve(NodeId solve);
    [[nodiscard]] NodeId rebuild_scalar(NodeId old) const;

    Graph& graph_;
    std::vector<NodeId> map_;
    std::vector<std::pair<NodeId, std::vector<NodeId>>> solutions_; ///< by ascending solve node
};

} // namespace lagen
