// SPDX-License-Identifier: GPL-2.0-or-later
/// Building trees, taking them down without recursion; names of trees, and trees compared.
#include "expression/tree.hpp"

#include "expression/find_part.hpp"

#include <set>
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

// Names of trees, and trees compared.

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
