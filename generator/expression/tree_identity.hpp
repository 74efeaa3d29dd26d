// SPDX-License-Identifier: GPL-2.0-or-later
/// Numbers for trees: two trees get the same number exactly when they have the same structure, numbers and names. Which
/// closed trees are each other's negatives as they are written.
#pragma once

#include "expression/fold.hpp"

#include <map>
#include <string>
#include <unordered_map>

namespace lagen {

/// Numbers are given in order of first sight. A tree that was numbered is kept alive, so its address stays its own.
class TreeIdentity {
  public:
    [[nodiscard]] std::size_t operator()(const Tree& tree);

  private:
    [[nodiscard]] std::size_t number_of(const TreeNode& node, const std::vector<std::size_t>& arguments);

    Fold<std::size_t> by_address_;
    std::map<std::string, std::size_t> by_content_;
};

/// A tree up to its sign: two trees with the same `number` and opposite signs add up to 0. `sign` is 0 for a tree that
/// is zero as written.
struct SignedNumber {
    int sign = 1;
    std::size_t number = 0;
};

/// Numbers trees up to sign, the order of terms and factors, and terms that cancel. It proves nothing beyond that:
/// sin(x)^2 + cos(x)^2 - 1 is not found to be zero.
class SignedIdentity {
  public:
    explicit SignedIdentity(TreeIdentity& identity) : identity_(identity) {}

    /// Recurses as deep as the tree, which closing bounds.
    SignedNumber operator()(const Tree& tree);

  private:
    SignedNumber number_of(const Tree& tree);
    SignedNumber sum(const TreeNode& node);
    SignedNumber product(const TreeNode& node);
    SignedNumber quotient(const TreeNode& node);
    SignedNumber power(const TreeNode& node);
    std::size_t number_for(std::string content)
    {
        return known_.emplace(std::move(content), known_.size()).first->second;
    }

    TreeIdentity& identity_;
    std::unordered_map<const TreeNode*, SignedNumber> done_; ///< looked up, never iterated
    std::vector<Tree> alive_;                                ///< a tree that was numbered keeps its address
    std::map<std::string, std::size_t> known_;
};

} // namespace lagen
