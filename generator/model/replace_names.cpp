// SPDX-License-Identifier: GPL-2.0-or-later
/// Names in trees replaced by trees.
#include "model/algebroid_draft.hpp"

namespace lagen {

namespace {

using Replacements = std::map<std::string, Tree>;

bool binds(const TreeNode& node, const Replacements& replacements)
{
    const bool sum = node.kind == TreeKind::sum_over || node.kind == TreeKind::product_over;
    return sum && replacements.contains(node.name);
}

/// A sum whose index hides one of the names.
Tree replace_in_sum(const Tree& sum, const Replacements& replacements)
{
    Replacements inner = replacements;
    inner.erase(sum->name);
    auto node = std::make_shared<TreeNode>(*sum);
    for (std::size_t k = 0; k < 2; ++k) node->arguments[k] = replace_names(sum->arguments[k], replacements);
    node->arguments[2] = replace_names(sum->arguments[2], inner);
    return node;
}

/// `tree` with the arguments that `done` has for its own.
Tree rebuilt(const Tree& tree, const std::map<const TreeNode*, Tree>& done)
{
    std::shared_ptr<TreeNode> node;
    for (std::size_t k = 0; k < tree->arguments.size(); ++k) {
        const Tree& next = done.at(tree->arguments[k].get());
        if (next == tree->arguments[k]) continue;
        if (node == nullptr) node = std::make_shared<TreeNode>(*tree);
        node->arguments[k] = next;
    }
    return node != nullptr ? Tree(node) : tree;
}

} // namespace

Tree replace_names(const Tree& tree, const Replacements& replacements)
{
    if (tree == nullptr || replacements.empty()) return tree;
    std::map<const TreeNode*, Tree> done;
    std::vector<Tree> stack{tree};
    while (!stack.empty()) {
        const Tree top = stack.back();
        if (done.contains(top.get())) {
            stack.pop_back();
            continue;
        }
        const auto found = top->kind == TreeKind::name ? replacements.find(top->name) : replacements.end();
        if (found != replacements.end()) {
            done.emplace(top.get(), found->second);
        } else if (binds(*top, replacements)) {
            done.emplace(top.get(), replace_in_sum(top, replacements));
        } else {
            const std::size_t before = stack.size();
            for (const Tree& argument : top->arguments)
                if (!done.contains(argument.get())) stack.push_back(argument);
            if (stack.size() > before) continue;
            done.emplace(top.get(), rebuilt(top, done));
        }
        stack.pop_back();
    }
    return done.at(tree.get());
}

} // namespace lagen
