// SPDX-License-Identifier: GPL-2.0-or-later
/// Closed trees to graph nodes and back.
#pragma once

#include "expression/fold.hpp"
#include "graph/core/graph.hpp"

#include <functional>
#include <map>

namespace lagen {

/// The nodes that names stand for while lowering. A name that is absent becomes (or is) the graph input of that name.
using Binding = std::map<std::string, NodeId>;

/// Memoised by tree address, so shared definitions are lowered once.
class Lowering {
  public:
    explicit Lowering(Graph& graph, Binding binding = {}) : graph_(graph), binding_(std::move(binding)) {}
    /// Throws ModelError at the division where a divisor is the constant 0 after folding, or 0^0, 0^-n.
    NodeId operator()(const Tree& tree);

  private:
    Graph& graph_;
    Binding binding_;
    Fold<NodeId> nodes_;
};

/// A node as a tree (shared nodes become shared trees). Solve components are refused (InternalError).
[[nodiscard]] Tree to_tree(const Graph& graph, NodeId id);

/// The same of several nodes, operands before their users: `put` answers what stands for a node with this tree.
[[nodiscard]] std::vector<Tree> to_trees(const Graph& graph, std::span<const NodeId> roots,
                                         const std::function<Tree(NodeId, Tree)>& put);

} // namespace lagen
