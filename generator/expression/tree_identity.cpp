// SPDX-License-Identifier: GPL-2.0-or-later
#include "expression/tree_identity.hpp"

namespace lagen {

std::size_t TreeIdentity::operator()(const Tree& tree)
{
    return by_address_(tree, [this](const Tree& part, const std::vector<std::size_t>& arguments) {
        return number_of(*part, arguments);
    });
}

/// The number of a node whose arguments have theirs: looked up by kind, content and the arguments' numbers.
std::size_t TreeIdentity::number_of(const TreeNode& node, const std::vector<std::size_t>& arguments)
{
    std::string content = std::to_string(static_cast<int>(node.kind));
    content += ':';
    if (node.kind == TreeKind::number || node.kind == TreeKind::solve) content += node.number.get_str();
    if (node.kind == TreeKind::call) content += std::to_string(static_cast<int>(node.function));
    if (node.kind == TreeKind::compare) content += std::to_string(static_cast<int>(node.comparison));
    if (node.kind == TreeKind::name || node.kind == TreeKind::apply || node.kind == TreeKind::sum_over ||
        node.kind == TreeKind::product_over)
        content += node.name;
    for (const std::size_t argument : arguments) content += ',' + std::to_string(argument);
    return by_content_.emplace(std::move(content), by_content_.size()).first->second;
}

} // namespace lagen
