// SPDX-License-Identifier: GPL-2.0-or-later
/// Bottom-up numbering of trees, with a stack of its own.
#include "expression/tree_identity.hpp"

#include <utility>

namespace lagen {

std::size_t TreeIdentity::operator()(const Tree& tree)
{
    if (const auto known = by_address_.find(tree.get()); known != by_address_.end()) return known->second;
    alive_.push_back(tree);
    std::vector<std::pair<const TreeNode*, bool>> pending{{tree.get(), false}}; // true: its arguments are numbered
    while (!pending.empty()) {
        const auto [node, ready] = pending.back();
        pending.pop_back();
        if (by_address_.contains(node)) continue;
        if (ready) {
            by_address_.emplace(node, number_of(*node));
            continue;
        }
        pending.emplace_back(node, true);
        for (const Tree& argument : node->arguments) pending.emplace_back(argument.get(), false);
    }
    return by_address_.at(tree.get());
}

/// The number of a node whose arguments have theirs: looked up by kind, content and the arguments' numbers.
std::size_t TreeIdentity::number_of(const TreeNode& node)
{
    std::string content = std::to_string(static_cast<int>(node.kind));
    content += ':';
    if (node.kind == TreeKind::number || node.kind == TreeKind::solve) content += node.number.get_str();
    if (node.kind == TreeKind::call) content += std::to_string(static_cast<int>(node.function));
    if (node.kind == TreeKind::compare) content += std::to_string(static_cast<int>(node.comparison));
    if (node.kind == TreeKind::name || node.kind == TreeKind::apply || node.kind == TreeKind::sum_over ||
        node.kind == TreeKind::product_over)
        content += node.name;
    for (const Tree& argument : node.arguments) {
        content += ',';
        content += std::to_string(by_address_.at(argument.get()));
    }
    return by_content_.emplace(std::move(content), by_content_.size()).first->second;
}

} // namespace lagen
