// SPDX-License-Identifier: GPL-2.0-or-later
/// Expressions by choice: leaves are variables, small rationals and pi.
#include "fuzz/grow_tree.hpp"

namespace lagen::fuzz {

namespace {

Tree grow_leaf(Choices& choices)
{
    const std::size_t kind = choices.below(8);
    if (kind < 3) return name("x");
    if (kind == 3) return name("y");
    if (kind == 4) return name("z");
    if (kind == 5) return number(static_cast<long>(choices.below(7)));
    if (kind == 6) {
        Rational value(static_cast<long>(choices.below(200)) - 100, static_cast<long>(choices.below(30)) + 1);
        value.canonicalize();
        return number(value);
    }
    return constant_pi();
}

Tree grow_call(Choices& choices, std::size_t depth)
{
    std::vector<const FunctionEntry*> functions;
    for (const FunctionEntry& entry : function_table())
        if (!entry.array) functions.push_back(&entry);
    const FunctionEntry& entry = *functions[choices.below(functions.size())];
    if (entry.function == Function::stumpff)
        return call(entry.function, {number(static_cast<long>(choices.below(5))), grow(choices, depth - 1)});
    if (entry.function == Function::select) {
        const auto comparison = choices.below(2) == 0 ? Comparison::less : Comparison::greater_equal;
        Tree condition = compare(comparison, grow(choices, depth - 1), grow(choices, depth - 1));
        return call(entry.function, {condition, grow(choices, depth - 1), grow(choices, depth - 1)});
    }
    std::vector<Tree> arguments;
    for (std::size_t k = 0; k < entry.arity; ++k) arguments.push_back(grow(choices, depth - 1));
    return call(entry.function, arguments);
}

Tree grow_solve(Choices& choices, std::size_t depth)
{
    std::vector<Tree> matrix;
    std::vector<Tree> right;
    for (std::size_t k = 0; k < 4; ++k) matrix.push_back(grow(choices, depth - 1));
    for (std::size_t k = 0; k < 2; ++k) right.push_back(grow(choices, depth - 1));
    return solve_component(matrix, right, choices.below(2));
}

} // namespace

Tree grow(Choices& choices, std::size_t depth)
{
    if (depth == 0 || choices.used_up()) return grow_leaf(choices);
    const auto inner = [&] { return grow(choices, depth - 1); };
    switch (choices.below(12)) {
    case 0:
    case 1: return grow_leaf(choices);
    case 2: return add({inner(), inner()});
    case 3: return add({inner(), negate(inner())});
    case 4: return multiply({inner(), inner()});
    case 5: return multiply({inner(), inner(), inner()});
    case 6: return divide(inner(), inner());
    case 7: return power(inner(), number(static_cast<long>(choices.below(7)) - 2));
    case 8: return choices.below(4) == 0 ? power(inner(), inner()) : negate(inner());
    case 9: return choices.below(8) == 0 ? grow_solve(choices, depth) : add({inner(), inner(), inner()});
    default: return grow_call(choices, depth);
    }
}

bool has_kinks(const Tree& tree)
{
    if (tree->kind == TreeKind::call && !entry_of(tree->function).smooth) return true;
    for (const Tree& argument : tree->arguments)
        if (has_kinks(argument)) return true;
    return false;
}

} // namespace lagen::fuzz
