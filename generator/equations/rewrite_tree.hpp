// SPDX-License-Identifier: GPL-2.0-or-later
/// Closed trees with some of their parts replaced.
#pragma once

#include "expression/tree.hpp"

#include <functional>

namespace lagen {

/// `tree` with every node for which `replacement` gives a tree (not null) replaced by that tree, outermost first; what
/// was put in is not looked into. Shared parts stay shared.
[[nodiscard]] Tree rewrite_tree(const Tree& tree, const std::function<Tree(const Tree&)>& replacement);

} // namespace lagen
