// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/label_casimirs.hpp"

namespace lagen {
namespace {

/// An expansion keeps the place of the definition: what the user wrote out a second time stands elsewhere.
bool is_expansion(const Tree& tree, const Tree& value)
{
    const SourceRange& here = tree->where;
    const SourceRange& there = value->where;
    return there.file != nullptr && here.file == there.file && here.begin == there.begin && here.end == there.end &&
           same_tree(tree, value);
}

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

Tree label_casimirs(const Tree& tree, const std::vector<NamedTree>& casimirs)
{
    std::map<const TreeNode*, Tree> done;
    std::vector<std::pair<Tree, bool>> stack = {{tree, false}}; // a node, and whether its arguments are done
    while (!stack.empty()) {
        const auto [node, ready] = stack.back();
        stack.pop_back();
        if (done.contains(node.get())) continue;
        const NamedTree* label = nullptr;
        for (const NamedTree& casimir : casimirs)
            if (is_expansion(node, casimir.value)) label = &casimir;
        if (label != nullptr) {
            done.emplace(node.get(), name(label->name, node->where));
        } else if (ready) {
            done.emplace(node.get(), rebuilt(node, done));
        } else {
            stack.emplace_back(node, true);
            for (const Tree& argument : node->arguments) stack.emplace_back(argument, false);
        }
    }
    return done.at(tree.get());
}

} // namespace lagen
