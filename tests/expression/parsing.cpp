// SPDX-License-Identifier: GPL-2.0-or-later
#include "parsing.hpp"

namespace lagen::test {

namespace {

std::string head_of(const TreeNode& node)
{
    switch (node.kind) {
    case TreeKind::negate: return "negate";
    case TreeKind::add: return "add";
    case TreeKind::multiply: return "multiply";
    case TreeKind::divide: return "divide";
    case TreeKind::power: return "power";
    case TreeKind::call: return entry_of(node.function).name;
    case TreeKind::apply: return "apply " + node.name;
    case TreeKind::compare: return spelling(node.comparison);
    case TreeKind::solve: return "solve " + node.number.get_str();
    case TreeKind::array: return "array";
    case TreeKind::index: return "index";
    case TreeKind::sum_over: return "sum " + node.name;
    case TreeKind::product_over: return "product " + node.name;
    default: return "?";
    }
}

template <class Action>
std::string caught(Action action, bool whole)
{
    try {
        action();
    } catch (const ModelError& error) {
        return whole ? error.what() : error.diagnostic().message;
    }
    return "accepted";
}

} // namespace

std::string structure(const Tree& tree)
{
    if (tree->kind == TreeKind::number) return tree->number.get_str();
    if (tree->kind == TreeKind::name) return tree->name;
    if (tree->kind == TreeKind::pi) return "PI";
    std::string text = "(" + head_of(*tree);
    for (const Tree& argument : tree->arguments) text += " " + structure(argument);
    return text + ")";
}

std::string error_of(const std::string& text)
{
    return caught([&] { (void)parse_expression(whole_text("e", text)); }, true);
}

std::string error_of_comparison(const std::string& text)
{
    return caught([&] { (void)parse_comparison(whole_text("e", text)); }, true);
}

std::string sentence_of(const std::string& text)
{
    return caught([&] { (void)parse_expression(whole_text("e", text)); }, false);
}

} // namespace lagen::test
