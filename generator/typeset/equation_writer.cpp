// SPDX-License-Identifier: GPL-2.0-or-later
#include "typeset/equation_writer.hpp"

#include "text/alphabet.hpp"
#include "text/comma_list.hpp"

namespace lagen {
namespace {

constexpr std::size_t most_nodes = 100'000; ///< a shared tree may be exponentially long when written out

struct Piece {
    std::string text;
    Hold hold;
};

bool begins_with_function(const Tree& tree)
{
    const Tree& base = tree->kind == TreeKind::power ? tree->arguments[0] : tree;
    return base->kind == TreeKind::call && entry_of(base->function).raised_by_name;
}

class TreeWriter {
  public:
    explicit TreeWriter(const EquationSpelling& spelling) : spelling_(spelling) {}

    std::string write(const Tree& tree, Hold at_least, bool last = true)
    {
        const Piece piece = write_piece(tree, last);
        return piece.hold >= at_least ? piece.text : enclosed(piece.text);
    }

  private:
    Piece write_piece(const Tree& tree, bool last)
    {
        if (++written_ > most_nodes) return {spelling_.dots, Hold::atom};
        const std::vector<Tree>& parts = tree->arguments;
        switch (tree->kind) {
        case TreeKind::number: return write_number(tree->number);
        case TreeKind::pi: return {spelling_.pi, Hold::atom};
        case TreeKind::name:
            return {tree->name[0] == rate_mark ? spelling_.dotted(tree->name.substr(1)) : spelling_.symbol(tree->name),
                    Hold::atom};
        case TreeKind::sum_over:
            return {spelling_.sum_sign(tree) + write(parts[2], Hold::quotient, last), spelling_.fraction.hold};
        case TreeKind::negate: return {"-" + write(parts[0], Hold::quotient, last), Hold::sign};
        case TreeKind::add: return write_sum(tree);
        case TreeKind::multiply: return write_product(tree, last);
        case TreeKind::divide:
            return {fraction(write(parts[0], spelling_.fraction.above), write(parts[1], spelling_.fraction.below)),
                    spelling_.fraction.hold};
        case TreeKind::power: return write_power(tree, last);
        case TreeKind::call: return write_call(tree, last);
        case TreeKind::solve: return write_solve(tree);
        case TreeKind::apply: return write_vector_product(tree);
        case TreeKind::compare:
            return {write(parts[0], Hold::sum) + spelling_.comparisons[static_cast<std::size_t>(tree->comparison)] +
                        write(parts[1], Hold::sum),
                    Hold::sum};
        default: return {to_text(tree), Hold::sum};
        }
    }

    [[nodiscard]] std::string enclosed(const std::string& text) const
    {
        return spelling_.open + text + spelling_.close;
    }

    [[nodiscard]] std::string fraction(const std::string& above, const std::string& below) const
    {
        return spelling_.fraction.before + above + spelling_.fraction.between + below + spelling_.fraction.behind;
    }

    std::string above(const Tree& exponent)
    {
        const bool whole = exponent->kind == TreeKind::number && exponent->number.get_den() == 1;
        if (whole && spelling_.script_digits) return raised_digits(exponent->number.get_str());
        return spelling_.upper + write(exponent, spelling_.exponent) + spelling_.end_index;
    }

    [[nodiscard]] std::string below(const std::string& digits) const
    {
        return spelling_.script_digits ? lowered_digits(digits) : spelling_.lower + digits + spelling_.end_index;
    }

    [[nodiscard]] Piece write_number(const Rational& value) const
    {
        if (value.get_den() == 1) return {value.get_str(), value < 0 ? Hold::sign : Hold::atom};
        const Rational size = abs(value);
        return {(value < 0 ? "-" : "") + fraction(size.get_num().get_str(), size.get_den().get_str()),
                value < 0 ? Hold::sign : spelling_.fraction.hold};
    }

    /// sin^2(x) rather than (sin(x))^2. A name may be raised although its own subscript stays below.
    Piece write_power(const Tree& tree, bool last)
    {
        const Tree& base = tree->arguments[0];
        const std::string exponent = above(tree->arguments[1]);
        if (raised_by_name(tree))
            return {entry_of(base->function).*spelling_.function + exponent + write_argument(base->arguments[0], last),
                    Hold::power};
        const bool named = base->kind == TreeKind::name;
        return {(named ? spelling_.base(base->name) : write(base, Hold::atom)) + exponent, Hold::power};
    }

    /// The argument of a circular or hyperbolic function.
    std::string write_argument(const Tree& argument, bool last)
    {
        const std::string text = write(argument, Hold::sum);
        const bool bare = spelling_.bare_arguments && argument->kind == TreeKind::name && last;
        return bare ? " " + text : enclosed(text);
    }

    Piece write_call(const Tree& tree, bool last)
    {
        const std::vector<Tree>& arguments = tree->arguments;
        const FunctionEntry& entry = entry_of(tree->function);
        if (entry.raised_by_name)
            return {entry.*spelling_.function + write_argument(arguments[0], last), spelling_.call};
        if (tree->function == Function::sqrt)
            return {spelling_.root.before + write(arguments[0], spelling_.root.inside) + spelling_.root.behind,
                    spelling_.root.hold};
        const std::string first = write(arguments[0], Hold::sum);
        if (tree->function == Function::abs) return {spelling_.open_size + first + spelling_.close_size, Hold::atom};
        if (tree->function == Function::stumpff)
            return {"c" + below(first) + enclosed(write(arguments[1], Hold::sum)), spelling_.call};
        std::vector<std::string> texts{first};
        for (std::size_t k = 1; k < arguments.size(); ++k) texts.push_back(write(arguments[k], Hold::sum));
        return {entry.*spelling_.function + enclosed(comma_list(texts)), spelling_.call};
    }

    Piece write_sum(const Tree& tree)
    {
        SignedTexts terms;
        for (const Tree& argument : tree->arguments) {
            const SignedTree term = without_sign(argument);
            terms.emplace_back(term.negative, write(term.tree, Hold::quotient));
        }
        return {one_line(terms), Hold::sum};
    }

    /// A sum over an index takes in what stands behind it; as the last factor it needs no parentheses.
    Piece write_product(const Tree& tree, bool last)
    {
        std::string text;
        const std::vector<Tree>& factors = tree->arguments;
        for (std::size_t k = 0; k < factors.size(); ++k) {
            const Tree& factor = factors[k];
            const bool at_end = k + 1 == factors.size();
            if (!text.empty()) text += spelling_.times;
            if (!at_end && (is_vector_product(factor) || is_indexed_sum(factor)))
                text += enclosed(write(factor, Hold::sum));
            else
                text += write(factor, is_indexed_sum(factor) ? Hold::quotient : Hold::product,
                              at_end ? last : begins_with_function(factors[k + 1]));
        }
        return {text, is_indexed_sum(factors.back()) ? spelling_.fraction.hold : Hold::product};
    }

    Piece write_vector_product(const Tree& tree)
    {
        std::string text;
        for (const Tree& argument : tree->arguments) {
            if (!text.empty()) text += tree->name == "cross" ? spelling_.cross : spelling_.dot;
            text += is_vector_product(argument) ? enclosed(write(argument, Hold::sum)) : write(argument, Hold::product);
        }
        return {text, Hold::product};
    }

    /// Component k of A^-1 b, counted from 1.
    Piece write_solve(const Tree& tree)
    {
        const std::size_t n = solve_order(tree->arguments.size());
        const auto& [before, behind, column, row, inverse] = spelling_.matrix;
        std::string matrix, right;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j)
                matrix += (j != 0 ? column : i != 0 ? row : "") + write(tree->arguments[i * n + j], Hold::sum);
            right += (i != 0 ? row : "") + write(tree->arguments[n * n + i], Hold::sum);
        }
        return {enclosed(before + matrix + behind + inverse + " " + before + right + behind) +
                    below(Rational(tree->number + 1).get_str()),
                spelling_.call};
    }

    const EquationSpelling& spelling_;
    std::size_t written_ = 0;
};

} // namespace

std::string EquationWriter::write(const Tree& tree, Hold at_least, bool last) const
{
    return TreeWriter(spelling_).write(tree, at_least, last);
}

/// A factor in front of something; 1 is not written.
std::string EquationWriter::coefficient(const Tree& tree) const
{
    return is_one(tree) ? "" : write(tree, Hold::product, false) + spelling_.times;
}

SignedTexts EquationWriter::mass_terms(const Equation& equation) const
{
    SignedTexts terms;
    for (const TermGroup& entry : equation.mass) {
        const SignedTree mass = without_sign(entry.value);
        terms.emplace_back(mass.negative, entry.label.empty() ? write(mass.tree, Hold::quotient)
                                                              : coefficient(mass.tree) + spelling_.dotted(entry.label));
    }
    return terms;
}

/// e_a, a section, or e^a, a form.
std::string EquationWriter::basis(const std::string& name, bool of_sections) const
{
    return std::string("e") + (of_sections ? spelling_.lower : spelling_.upper) + spelling_.symbol(name) +
           spelling_.end_index;
}

std::string EquationWriter::left_side(const Equation& equation) const
{
    const std::string symbol = spelling_.symbol(equation.symbol);
    switch (equation.left) {
    case LeftSide::zero: return "0";
    case LeftSide::symbol: return symbol;
    case LeftSide::differential: return "d" + symbol;
    case LeftSide::form: return "d" + basis(equation.symbol, false);
    case LeftSide::bracket:
        return spelling_.open_set + symbol + ", " + spelling_.symbol(equation.other) + spelling_.close_set;
    case LeftSide::section: return basis(equation.symbol, true);
    case LeftSide::commutator: return "[" + basis(equation.symbol, true) + ", " + basis(equation.other, true) + "]";
    case LeftSide::component: {
        std::vector<std::string> arguments;
        for (const std::string& name : equation.arguments) arguments.push_back(spelling_.symbol(name));
        return symbol + "(" + comma_list(arguments) + ")";
    }
    case LeftSide::time_derivative: break;
    }
    return equation.mass.empty() ? spelling_.dotted(equation.symbol) : one_line(mass_terms(equation));
}

SignedTexts EquationWriter::right_terms(const Equation& equation) const
{
    const bool of_sections = equation.left == LeftSide::section || equation.left == LeftSide::commutator;
    SignedTexts terms;
    for (const SignedTree& term : right_side_terms(equation)) {
        std::string wedge;
        for (const std::string& name : term.basis)
            wedge += (wedge.empty() ? "" : spelling_.wedge) + basis(name, of_sections);
        terms.emplace_back(term.negative,
                           wedge.empty() ? write(term.tree, Hold::quotient) : coefficient(term.tree) + wedge);
    }
    if (terms.empty()) terms.emplace_back(false, "0");
    std::string ranges;
    for (const auto& [letter, from, to] : equation.ranges)
        ranges += (ranges.empty() ? spelling_.ranges.before : spelling_.ranges.between) + letter + " = " +
                  std::to_string(from) + spelling_.ranges.dots + std::to_string(to);
    terms.back().second += ranges + (ranges.empty() ? "" : ")");
    return terms;
}

SignedTexts EquationWriter::terms_of(const WhereItem& item) const
{
    Equation entry{LeftSide::symbol, {}, {}, {{"", item.values[0]}}};
    entry.ranges = item.ranges;
    return right_terms(entry);
}

std::vector<std::string> EquationWriter::entries_of(const WhereItem& item) const
{
    std::vector<std::string> entries;
    for (const Tree& value : item.values) entries.push_back(write(value, Hold::sum));
    return entries;
}

} // namespace lagen
