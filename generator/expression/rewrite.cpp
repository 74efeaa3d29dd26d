// SPDX-License-Identifier: GPL-2.0-or-later
#include "expression/rewrite.hpp"

#include "expression/fold.hpp"

#include <algorithm>

namespace lagen {
namespace {

bool is_repetition(const TreeNode& node)
{
    return node.kind == TreeKind::sum_over || node.kind == TreeKind::product_over;
}

/// A sum whose index hides one of the names, or would capture one that comes in.
Tree replace_in_sum(const Tree& sum, const TreesByName& replacements)
{
    TreesByName inner = replacements;
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

} // namespace

Tree rewrite(const Tree& tree, const std::function<Tree(const Tree&)>& replacement)
{
    const auto rebuilt = [](const Tree& part, const std::vector<Tree>& arguments) {
        if (arguments == part->arguments) return part;
        auto node = std::make_shared<TreeNode>(*part);
        node->arguments = arguments;
        return Tree(node);
    };
    const auto replaced = [&](const Tree& part) {
        const Tree other = replacement(part);
        return other != nullptr ? std::optional(other) : std::nullopt;
    };
    return Fold<Tree>()(tree, rebuilt, replaced);
}

Tree replace_names(const Tree& tree, const TreesByName& replacements)
{
    if (tree == nullptr || replacements.empty()) return tree;
    return rewrite(tree, [&](const Tree& part) -> Tree {
        const bool named = part->kind == TreeKind::name || part->kind == TreeKind::pi;
        if (const auto found = replacements.find(part->name); named && found != replacements.end())
            return found->second;
        const bool binds =
            is_repetition(*part) && (replacements.contains(part->name) || introduces(replacements, part->name));
        return binds ? replace_in_sum(part, replacements) : nullptr;
    });
}

bool introduces(const TreesByName& replacements, const std::string& name)
{
    return std::ranges::any_of(replacements, [&](const auto& entry) { return mentions(entry.second, name); });
}

std::string uncaptured_name(const std::string& name, const Tree& body, const TreesByName& replacements)
{
    std::string fresh = name + '_';
    while (mentions(body, fresh) || replacements.contains(fresh) || introduces(replacements, fresh)) fresh += '_';
    return fresh;
}

} // namespace lagen
