// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as LaTeX (amsmath), and names as LaTeX symbols.
#include "emit/print_equations.hpp"
#include "emit/print_equations_names.hpp"
#include "emit/print_equations_terms.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t line_width = 160;
constexpr std::size_t longest_formula = 100'000; ///< nodes; a shared tree may be exponentially long when written out

/// How tightly a text holds together, loosest first.
enum class Hold { sum, sign, product, power, atom };

struct Piece {
    std::string text;
    Hold hold;
};

const char* latex_function(Function function)
{
    switch (function) {
    case Function::sin: return "\\sin";
    case Function::cos: return "\\cos";
    case Function::tan: return "\\tan";
    case Function::asin: return "\\arcsin";
    case Function::acos: return "\\arccos";
    case Function::atan: return "\\arctan";
    case Function::atan2: return "\\operatorname{atan2}";
    case Function::sinh: return "\\sinh";
    case Function::cosh: return "\\cosh";
    case Function::tanh: return "\\tanh";
    case Function::exp: return "\\exp";
    case Function::log: return "\\log";
    case Function::minimum: return "\\min";
    case Function::maximum: return "\\max";
    case Function::sign: return "\\operatorname{sign}";
    case Function::select: return "\\operatorname{if}";
    case Function::sqrt:
    case Function::abs: break;
    }
    return "";
}

class LatexWriter {
  public:
    explicit LatexWriter(const LatexNames& names) : names_(names) {}

    std::string write(const Tree& tree, Hold at_least)
    {
        const Piece piece = write_piece(tree);
        return piece.hold >= at_least ? piece.text : "\\left(" + piece.text + "\\right)";
    }

  private:
    Piece write_piece(const Tree& tree)
    {
        written_ += 1;
        if (written_ > longest_formula) return {"\\dots", Hold::atom};
        switch (tree->kind) {
        case TreeKind::number: return write_number(tree->number);
        case TreeKind::pi: return {"\\pi", Hold::atom};
        case TreeKind::name: return {names_.symbol(tree->name), Hold::power};
        case TreeKind::negate: return {"-" + write(tree->arguments[0], Hold::product), Hold::sign};
        case TreeKind::add: return write_sum(tree);
        case TreeKind::multiply: return write_product(tree);
        case TreeKind::divide:
            return {"\\frac{" + write(tree->arguments[0], Hold::sum) + "}{" + write(tree->arguments[1], Hold::sum) +
                        "}",
                    Hold::product};
        case TreeKind::power:
            return {write_base(tree->arguments[0]) + "^{" + write(tree->arguments[1], Hold::sum) + "}", Hold::power};
        case TreeKind::call: return write_call(tree);
        case TreeKind::compare: return write_comparison(tree);
        case TreeKind::apply: break;
        }
        return {"\\dots", Hold::atom};
    }

    static Piece write_number(const Rational& value)
    {
        if (value.get_den() == 1) return {value.get_str(), value < 0 ? Hold::sign : Hold::atom};
        const std::string fraction =
            "\\frac{" + Rational(abs(value)).get_num().get_str() + "}{" + value.get_den().get_str() + "}";
        return {(value < 0 ? "-" : "") + fraction, value < 0 ? Hold::sign : Hold::product};
    }

    /// A symbol may be raised although it is no atom: its own subscript stays below.
    std::string write_base(const Tree& tree)
    {
        return tree->kind == TreeKind::name ? names_.raisable(tree->name) : write(tree, Hold::atom);
    }

    Piece write_sum(const Tree& tree)
    {
        std::string text;
        for (const Tree& argument : tree->arguments) {
            const SignedTree term = without_sign(argument);
            text += text.empty() ? (term.negative ? "-" : "") : (term.negative ? " - " : " + ");
            text += write(term.tree, Hold::product);
        }
        return {text, Hold::sum};
    }

    Piece write_product(const Tree& tree)
    {
        std::string text;
        for (const Tree& factor : tree->arguments) text += (text.empty() ? "" : "\\, ") + write(factor, Hold::product);
        return {text, Hold::product};
    }

    Piece write_call(const Tree& tree)
    {
        const std::string first = write(tree->arguments[0], Hold::sum);
        if (tree->function == Function::sqrt) return {"\\sqrt{" + first + "}", Hold::atom};
        if (tree->function == Function::abs) return {"\\left|" + first + "\\right|", Hold::atom};
        std::string text = latex_function(tree->function) + ("\\left(" + first);
        for (std::size_t k = 1; k < tree->arguments.size(); ++k) text += ", " + write(tree->arguments[k], Hold::sum);
        return {text + "\\right)", Hold::power};
    }

    Piece write_comparison(const Tree& tree)
    {
        static constexpr const char* signs[] = {" < ", " \\le ", " > ", " \\ge ", " = ", " \\ne "};
        return {write(tree->arguments[0], Hold::sum) + signs[static_cast<std::size_t>(tree->comparison)] +
                    write(tree->arguments[1], Hold::sum),
                Hold::sum};
    }

    const LatexNames& names_;
    std::size_t written_ = 0;
};

std::string left_side(const Equation& equation, const LatexNames& names)
{
    if (equation.left == LeftSide::zero) return "0";
    if (equation.left == LeftSide::symbol) return names.symbol(equation.symbol);
    if (equation.mass.empty()) return names.dotted(equation.symbol);
    std::string text;
    for (const TermGroup& entry : equation.mass) {
        const SignedTree mass = without_sign(entry.value);
        text += text.empty() ? (mass.negative ? "-" : "") : (mass.negative ? " - " : " + ");
        const bool one = mass.tree->kind == TreeKind::number && mass.tree->number == 1;
        text += (one ? "" : LatexWriter(names).write(mass.tree, Hold::product) + "\\, ") + names.dotted(entry.label);
    }
    return text;
}

void print_block(std::string& text, const EquationBlock& block, const LatexNames& names)
{
    text += "\\paragraph{" + escape_latex(block.title) + "} $" + block.latex_formula + "$\n\\begin{align*}\n";
    for (std::size_t e = 0; e < block.equations.size(); ++e) {
        const Equation& equation = block.equations[e];
        std::vector<std::pair<bool, std::string>> terms;
        for (const SignedTree& term : right_side_terms(equation))
            terms.emplace_back(term.negative, LatexWriter(names).write(term.tree, Hold::product));
        if (terms.empty()) terms.emplace_back(false, "0");
        text += "  " + left_side(equation, names) + " &= ";
        const std::vector<std::string> lines = wrap_terms(terms, 0, 0, line_width);
        for (std::size_t k = 0; k < lines.size(); ++k) text += (k == 0 ? "" : " \\\\\n  &\\quad ") + lines[k];
        text += e + 1 < block.equations.size() ? " \\\\\n" : "\n";
    }
    text += "\\end{align*}\n";
}

} // namespace

std::string latex_of(const Tree& tree, const EquationSet& symbols)
{
    return LatexWriter(LatexNames(symbols.symbols)).write(tree, Hold::sum);
}

std::string print_latex(const EquationSet& equations)
{
    const LatexNames names(equations.symbols);
    std::string text =
        "\\subsection*{" + escape_latex(equations.title.empty() ? equations.model : equations.title) + "}\n";
    for (const EquationBlock& block : equations.blocks)
        if (!block.equations.empty()) print_block(text, block, names);
    return text;
}

} // namespace lagen
