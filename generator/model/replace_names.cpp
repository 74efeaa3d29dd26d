// SPDX-License-Identifier: GPL-2.0-or-later
/// Names in trees replaced by trees. An index of a sum that is called like a name in one of the replacements is
/// renamed, so that it does not capture it.
#include "model/algebroid_draft.hpp"

#include <algorithm>

namespace lagen {

using Replacements = std::map<std::string, Tree>;

namespace {

bool binds(const TreeNode& node, const Replacements& replacements)
{
    const bool sum = node.kind == TreeKind::sum_over || node.kind == TreeKind::product_over;
    return sum && (replacements.contains(node.name) || introduces(replacements, node.name));
}

/// A sum whose index hides one of the names, or would capture one that comes in.
Tree replace_in_sum(const Tree& sum, const Replacements& replacements)
{
    Replacements inner = replacements;
    inner.erase(sum->name);
    auto node = std::make_shared<TreeNode>(*sum);
    if (introduces(replacements, sum->name)) {
        node->name = uncaptured_name(sum->name, sum->arguments[2], replacements);
        inner[sum->name] = name(node->name);
    }
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

bool introduces(const Replacements& replacements, const std::string& name)
{
    return std::any_of(replacements.begin(), replacements.end(), [&](const auto& entry) {
        const std::vector<std::string> names = names_in(entry.second);
        return std::find(names.begin(), names.end(), name) != names.end();
    });
}

std::string uncaptured_name(const std::string& name, const Tree& body, const Replacements& replacements)
{
    const std::vector<std::string> used = names_in(body);
    std::string fresh = name + '_';
    while (std::find(used.begin(), used.end(), fresh) != used.end() || replacements.contains(fresh) ||
           introduces(replacements, fresh))
        fresh += '_';
    return fresh;
}

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
        const bool named = top->kind == TreeKind::name || top->kind == TreeKind::pi;
        const auto found = named ? replacements.find(top->name) : replacements.end();
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
