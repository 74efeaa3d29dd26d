// SPDX-License-Identifier: GPL-2.0-or-later
/// The expansion of definitions, behind Scope::close.
#pragma once

#include "expression/measure.hpp"
#include "expression/scope.hpp"
#include "expression/tree_identity.hpp"

#include <unordered_map>

namespace lagen {

/// A closed tree with its size.
struct ClosedTree {
    Tree tree;
    Measure measure;
};

/// What the names of one body mean: for a function, its parameters are its arguments' closed trees.
struct Body {
    const Definition* definition = nullptr; ///< null: an expression outside of the definitions
    std::vector<ClosedTree> arguments;
    std::unordered_map<const TreeNode*, ClosedTree> done; ///< by address; looked up, never iterated
};

/// Everything that one set of names has expanded to, each definition once and each function once for each distinct list
/// of arguments.
class Expansion {
  public:
    /// The scope is passed at each call, since copies of a scope share one expansion.
    [[nodiscard]] ClosedTree close(const Scope& scope, const Tree& tree);

    /// The body of a definition, its parameters standing for themselves.
    void check(const Scope& scope, const Definition& definition);

  private:
    [[nodiscard]] ClosedTree close_node(const Tree& tree, Body& body);
    [[nodiscard]] ClosedTree close_name(const Tree& tree, const Body& body);
    [[nodiscard]] ClosedTree close_application(const Tree& tree, Body& body);
    [[nodiscard]] ClosedTree close_operation(const Tree& tree, Body& body);
    [[nodiscard]] std::vector<ClosedTree> close_arguments(const Tree& tree, Body& body);
    [[nodiscard]] ClosedTree expand(const Definition& definition, std::vector<ClosedTree> arguments,
                                    const SourceRange& use);
    [[nodiscard]] ClosedTree leaf(const Tree& tree) const;
    [[noreturn]] void unknown(const TreeNode& node, const Body& body, bool as_function) const;
    void refuse_cycle(const Definition& definition, const SourceRange& use) const;

    class Level;

    const Scope* scope_ = nullptr; ///< during a call of close or check
    std::size_t depth_ = 0;
    std::size_t nodes_ = 0; ///< made by expanding definitions
    std::vector<const Definition*> active_;
    std::map<std::string, ClosedTree> named_;
    std::map<std::pair<std::string, std::vector<std::size_t>>, ClosedTree> applied_;
    TreeIdentity identity_;
};

} // namespace lagen
