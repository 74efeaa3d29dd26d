// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/rewrite_tree.hpp"

#include <map>

namespace lagen {
namespace {

Tree rebuilt(const Tree& tree, const std::map<const TreeNode*, Tree>& done)
{
    TreeNode copy{tree->kind, tree->number, tree->name, tree->function, tree->comparison, {}, tree->where};
    bool changed = false;
    for (const Tree& argument : tree->arguments) {
        copy.arguments.push_back(done.at(argument.get()));
        changed = changed || copy.arguments.back() != argument;
    }
    return changed ? std::make_shared<const TreeNode>(std::move(copy)) : tree;
}

} // namespace

Tree rewrite_tree(const Tree& tree, const std::function<Tree(const Tree&)>& replacement)
{
    std::map<const TreeNode*, Tree> done;
    std::vector<std::pair<Tree, bool>> stack = {{tree, false}}; // a node, and whether its arguments are done
    while (!stack.empty()) {
        const auto [node, ready] = stack.back();
        stack.pop_back();
        if (done.contains(node.get())) continue;
        if (ready) {
            done.emplace(node.get(), rebuilt(node, done));
        } else if (Tree replaced = replacement(node)) {
            done.emplace(node.get(), std::move(replaced));
        } else {
            stack.emplace_back(node, true);
            for (const Tree& argument : node->arguments) stack.emplace_back(argument, false);
        }
    }
    return done.at(tree.get());
}

} // namespace lagen
