// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/sympy_writer.hpp"

#include "emit/print_equations_terms.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

constexpr std::size_t longest_sympy =
    50'000; ///< as GiNaC's door has it: equations are no longer, other functions may be

std::string enclosed_below(const std::string& text, SympyHold hold, SympyHold at_least)
{
    return hold >= at_least ? text : "(" + text + ")";
}

const char* relation_of(Comparison comparison)
{
    switch (comparison) {
    case Comparison::less: return "Lt";
    case Comparison::less_equal: return "Le";
    case Comparison::greater: return "Gt";
    case Comparison::greater_equal: return "Ge";
    case Comparison::equal: return "Eq";
    case Comparison::not_equal: return "Ne";
    }
    throw InternalError("a comparison without a name in SymPy");
}

/// SymPy's name of a function, where it is not the language's own.
std::string function_in_sympy(Function function)
{
    switch (function) {
    case Function::abs: return "Abs";
    case Function::minimum: return "Min";
    case Function::maximum: return "Max";
    default: return entry_of(function).name;
    }
}

} // namespace

std::string SympyWriter::write(const Tree& tree, SympyHold at_least)
{
    written_ = 0;
    const Piece whole = piece(tree);
    return enclosed_below(whole.text, whole.hold, at_least);
}

std::string SympyWriter::write_value(const Tree& tree)
{
    written_ = 0;
    const Piece whole = piece(tree);
    return whole.plain ? "sp.Integer(" + whole.text + ")" : whole.text;
}

SympyWriter::Piece SympyWriter::piece(const Tree& tree)
{
    if (++written_ > longest_sympy)
        throw MathematicsError(
            fmt::format("the expressions of model '{}' are too long to be written out for SymPy", model_),
            "[definitions] without arguments keep their names");
    if (const auto known = definitions_.find(identity_(tree)); known != definitions_.end()) return {known->second};
    return write_node(tree);
}

SympyWriter::Piece SympyWriter::write_node(const Tree& tree)
{
    switch (tree->kind) {
    case TreeKind::number:
        if (tree->number.get_den() == 1)
            return {tree->number.get_str(), tree->number < 0 ? SympyHold::sum : SympyHold::atom, true};
        return {fmt::format("sp.Rational({}, {})", tree->number.get_num().get_str(), tree->number.get_den().get_str())};
    case TreeKind::pi: return {"sp.pi"};
    case TreeKind::name: return {variable(tree->name)};
    case TreeKind::negate: {
        const Piece inner = piece(tree->arguments[0]);
        return {"-" + enclosed_below(inner.text, inner.hold, SympyHold::product), SympyHold::sum, inner.plain};
    }
    case TreeKind::add: return write_sum(tree);
    case TreeKind::multiply: return write_product(tree);
    case TreeKind::divide: return write_operation(tree, "/", SympyHold::product, SympyHold::power, SympyHold::product);
    case TreeKind::power: return write_operation(tree, "**", SympyHold::atom, SympyHold::atom, SympyHold::power);
    case TreeKind::call: return write_call(tree);
    case TreeKind::compare:
        return {fmt::format("sp.{}({})", relation_of(tree->comparison), listed(tree, 0, tree->arguments.size()))};
    case TreeKind::solve: return write_solve(tree);
    default: throw InternalError("an expression that is not closed");
    }
}

SympyWriter::Piece SympyWriter::write_sum(const Tree& tree)
{
    Piece sum{"", SympyHold::sum, true};
    for (const Tree& argument : tree->arguments) {
        const SignedTree term = without_sign(argument);
        const Piece value = piece(term.tree);
        sum.text += sum.text.empty() ? (term.negative ? "-" : "") : (term.negative ? " - " : " + ");
        sum.text += enclosed_below(value.text, value.hold, SympyHold::product);
        sum.plain = sum.plain && value.plain;
    }
    return tree->arguments.empty() ? Piece{"0", SympyHold::atom, true} : sum;
}

SympyWriter::Piece SympyWriter::write_product(const Tree& tree)
{
    Piece product{"", SympyHold::product, true};
    for (const Tree& argument : tree->arguments) {
        const Piece factor = piece(argument);
        product.text +=
            (product.text.empty() ? "" : "*") + enclosed_below(factor.text, factor.hold, SympyHold::product);
        product.plain = product.plain && factor.plain;
    }
    return tree->arguments.empty() ? Piece{"1", SympyHold::atom, true} : product;
}

SympyWriter::Piece SympyWriter::write_operation(const Tree& tree, const char* sign, SympyHold left, SympyHold right,
                                                SympyHold hold)
{
    const Piece first = piece(tree->arguments[0]);
    const Piece second = piece(tree->arguments[1]);
    const bool pythons = first.plain && second.plain;
    return {(pythons ? "sp.Integer(" + first.text + ")" : enclosed_below(first.text, first.hold, left)) + sign +
                enclosed_below(second.text, second.hold, right),
            hold};
}

SympyWriter::Piece SympyWriter::write_call(const Tree& tree)
{
    const std::size_t count = tree->arguments.size();
    if (tree->function == Function::stumpff)
        throw MathematicsError(fmt::format("model '{}' uses stumpff, which SymPy does not have", model_));
    if (tree->function == Function::select)
        return {fmt::format("sp.Piecewise(({}, {}), ({}, True))", listed(tree, 1, 1), listed(tree, 0, 1),
                            listed(tree, 2, 1))};
    return {fmt::format("sp.{}({})", function_in_sympy(tree->function), listed(tree, 0, count))};
}

SympyWriter::Piece SympyWriter::write_solve(const Tree& tree)
{
    const std::size_t m = solve_order(tree->arguments.size());
    return {fmt::format("sp.Matrix({0}, {0}, [{1}]).LUsolve(sp.Matrix([{2}]))[{3}]", m, listed(tree, 0, m * m),
                        listed(tree, m * m, m), tree->number.get_str())};
}

std::string SympyWriter::listed(const Tree& tree, std::size_t first, std::size_t count)
{
    std::string text;
    for (std::size_t k = first; k < first + count; ++k) {
        const Piece argument = piece(tree->arguments[k]);
        text += (k == first ? "" : ", ") + argument.text;
    }
    return text;
}

} // namespace lagen
