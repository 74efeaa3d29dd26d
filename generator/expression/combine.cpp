// SPDX-License-Identifier: GPL-2.0-or-later
/// Operations on shapes: which fit, and what comes of them.
#include "expression/combine.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr long most_stumpff = 32;

bool is_scalar(const Value& value)
{
    return value->shape.rank == Rank::scalar;
}

/// Every argument a scalar, and a scalar for a result.
bool of_scalars(const TreeNode& node, std::span<const Value> arguments)
{
    if (node.kind == TreeKind::array || node.kind == TreeKind::index || is_range(node)) return false;
    if (node.kind == TreeKind::call && entry_of(node.function).array) return false;
    return std::all_of(arguments.begin(), arguments.end(), is_scalar);
}

/// The k of stumpff(k, z) as a literal number, which is what later stages expect.
void require_order(const Maker& maker, const Tree& tree, std::vector<ClosedTree>& arguments)
{
    const std::optional<long> k = integer_of(*scalar(arguments[0]));
    if (!k || *k < 0 || *k > most_stumpff)
        refuse(tree->arguments[0], "the first argument of stumpff is not an integer from 0 to 32",
               "stumpff(k, z) = 1/k! - z/(k+2)! + z^2/(k+4)! - ...");
    if (arguments[0].tree->kind != TreeKind::number) arguments[0] = maker.number(*k);
}

Value combine_scalars(const Maker& maker, const Tree& tree, std::span<const Value> arguments, bool open)
{
    std::vector<ClosedTree> trees;
    trees.reserve(arguments.size());
    for (const Value& argument : arguments) trees.push_back(maker.entry(*argument, 0));
    if (tree->kind == TreeKind::call && tree->function == Function::stumpff && !open) require_order(maker, tree, trees);
    Value result = scalar(maker.operation(tree, std::move(trees)));
    result->open = open;
    const auto neutral = [](const Value& value) { return value->neutral; };
    switch (tree->kind) {
    case TreeKind::negate:
    case TreeKind::multiply: result->neutral = std::any_of(arguments.begin(), arguments.end(), neutral); break;
    case TreeKind::add: result->neutral = std::all_of(arguments.begin(), arguments.end(), neutral); break;
    case TreeKind::divide: result->neutral = arguments[0]->neutral; break;
    default: break;
    }
    return result;
}

Value negate_array(const Maker& maker, const Value& value)
{
    std::vector<ClosedTree> entries;
    entries.reserve(value->shape.size());
    for (const ClosedTree& entry : maker.entries(*value)) entries.push_back(maker.negate(entry));
    return array_value(maker, value->shape, std::move(entries));
}

Value divide_array(const Maker& maker, const Tree& tree, const Value& above, const Value& below)
{
    if (!is_scalar(below))
        refuse(tree, fmt::format("{} is divided by {}", to_text(above->shape), to_text(below->shape)),
               below->shape.rank == Rank::matrix ? "A^-1 b is written inverse(A)*b" : "the divisor is a scalar");
    const ClosedTree& divisor = maker.entry(*below, 0);
    std::vector<ClosedTree> entries;
    entries.reserve(above->shape.size());
    for (const ClosedTree& entry : maker.entries(*above)) entries.push_back(maker.divide(entry, divisor));
    return array_value(maker, above->shape, std::move(entries));
}

[[noreturn]] void refuse_comparison(const Tree& tree, std::span<const Value> arguments)
{
    const std::size_t k = is_scalar(arguments[0]) ? 1 : 0;
    refuse(tree->arguments[k], fmt::format("{} is compared", to_text(arguments[k]->shape)),
           "scalars are compared: entries, or a norm");
}

Value combine_arrays(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    switch (tree->kind) {
    case TreeKind::array: return join_entries(maker, tree, arguments);
    case TreeKind::index: return pick_entry(maker, tree, arguments);
    case TreeKind::apply: return close_range(tree, arguments);
    case TreeKind::negate: return negate_array(maker, arguments[0]);
    case TreeKind::add: return add_values(maker, arguments, tree->arguments);
    case TreeKind::multiply: return multiply_values(maker, arguments);
    case TreeKind::divide: return divide_array(maker, tree, arguments[0], arguments[1]);
    case TreeKind::power: return power_of_matrix(maker, tree, arguments[0], arguments[1]);
    case TreeKind::compare: refuse_comparison(tree, arguments);
    case TreeKind::call: return call_on_arrays(maker, tree, arguments);
    default: break;
    }
    throw InternalError("closing: an operation on arrays that is none");
}

} // namespace

void refuse(const Tree& argument, const std::string& message, const std::string& hint)
{
    throw ModelError(message, argument->where, hint);
}

Value combine(const Maker& maker, const Tree& tree, std::vector<Value> arguments)
{
    const bool open = std::any_of(arguments.begin(), arguments.end(), [](const Value& value) { return value->open; });
    if (of_scalars(*tree, arguments)) return combine_scalars(maker, tree, arguments, open);
    if (!open) return combine_arrays(maker, tree, arguments);
    return open_value(tree->where);
}

Value open_value(const SourceRange& where)
{
    const Tree stand_in = name("?", where); // nothing is said of shapes
    Value result = scalar({stand_in, measure(*stand_in, {}, closing_limits())});
    result->open = true;
    return result;
}

} // namespace lagen
