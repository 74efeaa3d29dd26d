// SPDX-License-Identifier: GPL-2.0-or-later
/// The expansion of definitions, behind Scope::close.
#pragma once

#include "expression/measure.hpp"
#include "expression/scope.hpp"
#include "expression/tree_identity.hpp"

#include <map>
#include <utility>
#include <vector>

namespace lagen {

/// A closed tree with its size.
struct ClosedTree {
    Tree tree;
    Measure measure;
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
    class Closing;
    /// A definition with the numbers of its arguments' trees.
    using Key = std::pair<std::string, std::vector<std::size_t>>;

    std::size_t operations_ = 0; ///< made by expanding definitions
    std::map<Key, ClosedTree> expanded_;
    TreeIdentity identity_;
};

} // namespace lagen
