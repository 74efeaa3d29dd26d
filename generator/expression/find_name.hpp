// SPDX-License-Identifier: GPL-2.0-or-later
/// Where a name of some sort first occurs.
#pragma once

#include "expression/tree.hpp"

#include <functional>

namespace lagen {

/// The first name in `trees`, depth first and left to right, that `is_wanted`; null where there is none. Shared trees
/// are walked once.
[[nodiscard]] const TreeNode* find_name(const std::vector<Tree>& trees,
                                        const std::function<bool(const std::string&)>& is_wanted);

} // namespace lagen
