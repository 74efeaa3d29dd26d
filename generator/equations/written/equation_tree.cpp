// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/equation_tree.hpp"

#include <algorithm>

namespace lagen {
namespace {

bool is_rate(const Tree& tree)
{
    return tree->kind == TreeKind::name && tree->name.starts_with(rate_mark);
}

} // namespace

bool is_plain(const Equation& equation)
{
    return (equation.left == LeftSide::time_derivative || equation.left == LeftSide::symbol ||
            equation.left == LeftSide::zero) &&
           equation.relation == Relation::equal &&
           std::ranges::all_of(equation.groups, [](const TermGroup& group) { return group.basis.empty(); });
}

Tree array_of(std::vector<Tree> entries)
{
    TreeNode node;
    node.kind = TreeKind::array;
    node.arguments = std::move(entries);
    return std::make_shared<const TreeNode>(std::move(node));
}

Tree times_rate(const Tree& value, const Tree& rate)
{
    return value->kind == TreeKind::number && value->number == 1 ? rate : multiply({value, rate});
}

bool is_mass_times_rate(const Tree& tree)
{
    return tree->kind == TreeKind::multiply && tree->arguments.size() == 2 && is_rate(tree->arguments[1]);
}

Tree tree_of(const Equation& equation)
{
    std::vector<Tree> mass, groups;
    for (const TermGroup& entry : equation.mass)
        mass.push_back(entry.label.empty() ? entry.value : times_rate(entry.value, name(rate_mark + entry.label)));
    for (const TermGroup& group : equation.groups) groups.push_back(group.value);
    return array_of({name(equation.symbol), array_of(mass), array_of(groups)});
}

Equation with_tree(Equation equation, const Tree& tree)
{
    equation.symbol = tree->arguments[0]->name;
    equation.mass.clear();
    for (const Tree& entry : tree->arguments[1]->arguments) {
        if (is_mass_times_rate(entry))
            equation.mass.push_back({entry->arguments[1]->name.substr(1), entry->arguments[0]});
        else if (is_rate(entry))
            equation.mass.push_back({entry->name.substr(1), number(1)});
        else
            equation.mass.push_back({"", entry});
    }
    std::vector<TermGroup> groups;
    const std::vector<Tree>& values = tree->arguments[2]->arguments;
    for (std::size_t k = 0; k < values.size(); ++k)
        groups.push_back({values.size() == equation.groups.size() ? equation.groups[k].label : "", values[k]});
    equation.groups = std::move(groups);
    return equation;
}

} // namespace lagen
