// SPDX-License-Identifier: GPL-2.0-or-later
/// Building trees, and taking them down without recursion.
#include "expression/tree.hpp"

#include <utility>

namespace lagen {

namespace {

Tree node(TreeKind kind, std::vector<Tree> arguments)
{
    auto result = std::make_shared<TreeNode>();
    result->kind = kind;
    result->arguments = std::move(arguments);
    return result;
}

} // namespace

TreeNode::~TreeNode()
{
    // A chain of a million nodes would overflow the stack if each released the next: take them down in a loop.
    std::vector<Tree> doomed = std::move(arguments);
    while (!doomed.empty()) {
        const Tree last = std::move(doomed.back());
        doomed.pop_back();
        if (!last || last.use_count() > 1 || last->arguments.empty()) continue;
        auto& children = const_cast<TreeNode&>(*last).arguments; // nobody else sees the node any more
        for (Tree& child : children) doomed.push_back(std::move(child));
        children.clear();
    }
}

const FunctionEntry* find_function(std::string_view name)
{
    for (const FunctionEntry& entry : function_table())
        if (name == entry.name) return &entry;
    return name == "tr" ? &entry_of(Function::trace) : nullptr;
}

bool is_function_name(std::string_view name)
{
    return find_function(name) || name == "sum" || name == "product";
}

bool is_reserved_name(std::string_view name)
{
    const FunctionEntry* function = find_function(name);
    return function && !function->array;
}

Tree number(Rational value, SourceRange where)
{
    auto result = std::make_shared<TreeNode>();
    result->number = std::move(value);
    result->number.canonicalize();
    result->where = std::move(where);
    return result;
}

Tree name(std::string symbol, SourceRange where)
{
    auto result = std::make_shared<TreeNode>();
    result->kind = TreeKind::name;
    result->name = std::move(symbol);
    result->where = std::move(where);
    return result;
}

Tree constant_pi(SourceRange where)
{
    auto result = std::make_shared<TreeNode>();
    result->kind = TreeKind::pi;
    result->where = std::move(where);
    return result;
}

Tree negate(Tree a)
{
    return node(TreeKind::negate, {std::move(a)});
}
Tree add(std::vector<Tree> terms)
{
    return node(TreeKind::add, std::move(terms));
}
Tree multiply(std::vector<Tree> factors)
{
    return node(TreeKind::multiply, std::move(factors));
}
Tree divide(Tree a, Tree b)
{
    return node(TreeKind::divide, {std::move(a), std::move(b)});
}
Tree power(Tree base, Tree exponent)
{
    return node(TreeKind::power, {std::move(base), std::move(exponent)});
}

Tree call(Function function, std::vector<Tree> arguments)
{
    auto result = std::make_shared<TreeNode>();
    result->kind = TreeKind::call;
    result->function = function;
    result->arguments = std::move(arguments);
    return result;
}

Tree application(std::string function, std::vector<Tree> arguments)
{
    auto result = std::make_shared<TreeNode>();
    result->kind = TreeKind::apply;
    result->name = std::move(function);
    result->arguments = std::move(arguments);
    return result;
}

Tree compare(Comparison comparison, Tree a, Tree b)
{
    auto result = std::make_shared<TreeNode>();
    result->kind = TreeKind::compare;
    result->comparison = comparison;
    result->arguments = {std::move(a), std::move(b)};
    return result;
}

Tree solve_component(std::vector<Tree> matrix, const std::vector<Tree>& right, std::size_t k)
{
    auto result = std::make_shared<TreeNode>();
    result->kind = TreeKind::solve;
    result->number = Rational(static_cast<unsigned long>(k));
    result->arguments = std::move(matrix);
    result->arguments.insert(result->arguments.end(), right.begin(), right.end());
    return result;
}

std::size_t solve_order(std::size_t arguments)
{
    std::size_t m = 0;
    while (m * m + m < arguments) ++m;
    return m;
}

} // namespace lagen
