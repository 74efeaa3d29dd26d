// SPDX-License-Identifier: GPL-2.0-or-later
/// Constant sub-expressions without a real value, as log(0), sqrt(-2), asin(2), tan(pi/2), 1/sin(pi), (-2)^(1/2),
/// atan2(0, 0): expressions that contain one are defined nowhere. Signs are decided by enclosures, zeros by exact
/// algebra; what neither decides is let pass.
#pragma once

#include "graph/core/lower.hpp"

#include <optional>
#include <set>
#include <vector>

namespace lagen {

class ConstantValues {
  public:
    /// Throws ModelError, at its place, for the first constant part of `tree` that certainly has no value. A part
    /// counts as constant where no name is left in it once it is folded (log(x - x) is log(0)); the branch of an if()
    /// that a constant condition does not take is not looked at.
    void require(const Tree& tree);

  private:
    void require_node(const TreeNode& node);
    void require_call(const TreeNode& node);
    void require_power(const TreeNode& node);
    void require_positive(const TreeNode& node, const char* function);
    [[nodiscard]] std::optional<std::size_t> only_branch(const TreeNode& node);
    [[nodiscard]] NodeId node_of(const TreeNode& node, std::size_t argument);
    [[nodiscard]] bool is_constant(NodeId node);
    /// -1, 0 or 1; nothing where the node is not constant, or its sign is not decided.
    [[nodiscard]] std::optional<int> sign_of(NodeId node);

    Graph graph_;
    Lowering lower_{graph_};
    std::set<const TreeNode*> done_; ///< kept alive by `lower_`
    std::vector<bool> varies_;       ///< by node: an input stands below it
};

} // namespace lagen
