// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of trees, and trees compared.
#include "expression/find_part.hpp"

#include <set>
#include <utility>

namespace lagen {

namespace {

bool same_node(const TreeNode& a, const TreeNode& b)
{
    if (a.kind != b.kind || a.arguments.size() != b.arguments.size()) return false;
    switch (a.kind) {
    case TreeKind::number:
    case TreeKind::solve: return a.number == b.number;
    case TreeKind::name:
    case TreeKind::apply:
    case TreeKind::sum_over:
    case TreeKind::product_over: return a.name == b.name;
    case TreeKind::call: return a.function == b.function;
    case TreeKind::compare: return a.comparison == b.comparison;
    default: return true;
    }
}

} // namespace

std::vector<std::string> names_in(const Tree& tree)
{
    std::vector<std::string> names;
    std::set<std::string_view> known; // of node names, which outlive the walk
    for_each_part(tree, [&](const Tree& part) {
        if (part->kind == TreeKind::name && known.insert(part->name).second) names.push_back(part->name);
    });
    return names;
}

bool mentions(const Tree& tree, const std::string& name)
{
    return find_name({tree}, [&](const std::string& each) { return each == name; }) != nullptr;
}

Tree find_name(const std::vector<Tree>& trees, const std::function<bool(const std::string&)>& is_wanted)
{
    PartSearch search;
    for (const Tree& tree : trees) {
        const auto wanted = [&](const Tree& part) { return part->kind == TreeKind::name && is_wanted(part->name); };
        if (Tree found = search(tree, wanted)) return found;
    }
    return nullptr;
}

bool same_tree(const Tree& a, const Tree& b)
{
    using Pair = std::pair<const TreeNode*, const TreeNode*>;
    std::set<Pair> visited;
    std::vector<Pair> pending{{a.get(), b.get()}};
    while (!pending.empty()) {
        const auto [left, right] = pending.back();
        pending.pop_back();
        if (left == right || !visited.insert({left, right}).second) continue;
        if (!left || !right || !same_node(*left, *right)) return false;
        for (std::size_t k = 0; k < left->arguments.size(); ++k)
            pending.emplace_back(left->arguments[k].get(), right->arguments[k].get());
    }
    return true;
}

} // namespace lagen
