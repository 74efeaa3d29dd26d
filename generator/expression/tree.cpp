// SPDX-License-Identifier: GPL-2.0-or-later
/// Building trees, and taking them down without recursion.
#include "expression/tree.hpp"

#include <array>
#include <utility>

namespace lagen {

namespace {

constexpr std::array functions{
    FunctionEntry{Function::sin, "sin", 1, true},
    FunctionEntry{Function::cos, "cos", 1, true},
    FunctionEntry{Function::tan, "tan", 1, true},
    FunctionEntry{Function::asin, "asin", 1, true},
    FunctionEntry{Function::acos, "acos", 1, true},
    FunctionEntry{Function::atan, "atan", 1, true},
    FunctionEntry{Function::atan2, "atan2", 2, true},
    FunctionEntry{Function::sinh, "sinh", 1, true},
    FunctionEntry{Function::cosh, "cosh", 1, true},
    FunctionEntry{Function::tanh, "tanh", 1, true},
    FunctionEntry{Function::exp, "exp", 1, true},
    FunctionEntry{Function::log, "log", 1, true},
    FunctionEntry{Function::sqrt, "sqrt", 1, true},
    FunctionEntry{Function::abs, "abs", 1, true},
    FunctionEntry{Function::minimum, "min", 2, false},
    FunctionEntry{Function::maximum, "max", 2, false},
    FunctionEntry{Function::sign, "sign", 1, false},
    FunctionEntry{Function::select, "if", 3, false},
    FunctionEntry{Function::stumpff, "stumpff", 2, true},
    FunctionEntry{Function::dot, "dot", 2, true, true},
    FunctionEntry{Function::cross, "cross", 2, true, true},
    FunctionEntry{Function::norm, "norm", 1, true, true},
    FunctionEntry{Function::trace, "trace", 1, true, true},
    FunctionEntry{Function::transpose, "transpose", 1, true, true},
    FunctionEntry{Function::det, "det", 1, true, true},
    FunctionEntry{Function::inverse, "inverse", 1, true, true},
    FunctionEntry{Function::diag, "diag", 1, true, true},
    FunctionEntry{Function::identity, "identity", 1, true, true},
    FunctionEntry{Function::hat, "hat", 1, true, true},
    FunctionEntry{Function::vee, "vee", 1, true, true},
    FunctionEntry{Function::cay, "cay", 1, true, true},
};

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

std::span<const FunctionEntry> function_table()
{
    return functions;
}

const FunctionEntry* find_function(std::string_view name)
{
    for (const FunctionEntry& entry : functions)
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

const FunctionEntry& entry_of(Function function)
{
    return functions[static_cast<std::size_t>(function)];
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

const char* spelling(Comparison comparison)
{
    switch (comparison) {
    case Comparison::less: return "<";
    case Comparison::less_equal: return "<=";
    case Comparison::greater: return ">";
    case Comparison::greater_equal: return ">=";
    case Comparison::equal: return "==";
    case Comparison::not_equal: return "!=";
    }
    return "?";
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
