// SPDX-License-Identifier: GPL-2.0-or-later
/// Nodes as expressions, in exactly the order of evaluation of the graph, down to those that have a name.
#pragma once

#include "emit/statement.hpp"

namespace lagen {

class NodeExpressions {
  public:
    /// `type`: of the values that `select` chooses between.
    explicit NodeExpressions(const Graph& graph, std::string type = "S");

    /// From now on the node stands as this variable (or number).
    void name(NodeId id, Expression variable) { names_[id] = std::move(variable); }
    [[nodiscard]] bool has_name(NodeId id) const { return names_[id].has_value(); }

    /// The node by its name, else its operation on its operands. Parts without a name nest no deeper than plan_body
    /// allows.
    [[nodiscard]] Expression operator()(NodeId id) const;
    /// The operation itself, even where the node has a name.
    [[nodiscard]] Expression operation(NodeId id) const;

  private:
    [[nodiscard]] bool comes_first(NodeId a, NodeId b) const;

    const Graph& graph_;
    std::string type_;
    std::vector<std::optional<Expression>> names_;
    std::vector<NodeId> latest_; ///< by node: the latest input that it depends on
};

} // namespace lagen
