// SPDX-License-Identifier: GPL-2.0-or-later
/// Numbers for trees: two trees get the same number exactly when they have the same structure, numbers and names.
#pragma once

#include "expression/fold.hpp"

#include <map>
#include <string>

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

} // namespace lagen
