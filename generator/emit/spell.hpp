// SPDX-License-Identifier: GPL-2.0-or-later
/// Nodes as C++ expressions with the fewest parentheses, in exactly the order of evaluation of the graph.
#pragma once

#include "emit/print_literal.hpp"
#include "graph/core/graph.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lagen {

class Speller {
  public:
    explicit Speller(const Graph& graph);

    /// From now on the node is written as this name (or closed expression).
    void name(NodeId id, std::string text) { names_[id] = std::move(text); }
    [[nodiscard]] bool has_name(NodeId id) const { return !names_[id].empty(); }

    /// The node by its name, else its operation on its operands. Parts without a name nest no deeper than plan_body
    /// allows.
    Spelling operator()(NodeId id);
    /// The operation itself, even where the node has a name.
    Spelling operation(NodeId id);
    /// In parentheses unless it binds at least as tightly as `precedence`.
    std::string at_least(int precedence, NodeId id);

    [[nodiscard]] const std::set<std::string>& functions() const { return functions_; }
    /// Notes that `function` is called and gives its name back.
    std::string call(const std::string& function);

  private:
    Spelling add(NodeId a, NodeId b);
    Spelling subtract(NodeId a, NodeId b);
    Spelling multiply(NodeId a, NodeId b);
    std::optional<Spelling> negated(NodeId id);
    Spelling power(NodeId base, int exponent);
    Spelling function(NodeId id);
    Spelling choice(NodeId id);
    Spelling condition(NodeId id);
    Spelling comparison(NodeId id);

    const Graph& graph_;
    std::vector<std::string> names_;
    std::vector<NodeId> latest_; ///< by node: the latest input that it depends on
    std::set<std::string> functions_;
};

/// The declaration by which kernels call `function`: `using std::sin;`.
[[nodiscard]] std::string using_declaration(const std::string& function);

} // namespace lagen
