// SPDX-License-Identifier: GPL-2.0-or-later
#include "expression/find_name.hpp"

#include <set>

namespace lagen {

const TreeNode* find_name(const std::vector<Tree>& trees, const std::function<bool(const std::string&)>& is_wanted)
{
    std::set<const TreeNode*> seen;
    std::vector<const TreeNode*> stack;
    for (auto tree = trees.rbegin(); tree != trees.rend(); ++tree) stack.push_back(tree->get());
    while (!stack.empty()) {
        const TreeNode* node = stack.back();
        stack.pop_back();
        if (!seen.insert(node).second) continue;
        if (node->kind == TreeKind::name && is_wanted(node->name)) return node;
        for (auto argument = node->arguments.rbegin(); argument != node->arguments.rend(); ++argument)
            stack.push_back(argument->get());
    }
    return nullptr;
}

} // namespace lagen
