// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as LaTeX (amsmath), and names as LaTeX symbols.
#include "emit/print_equations.hpp"
#include "emit/print_equations_terms.hpp"
#include "emit/text_block.hpp"
#include "expression/alphabet.hpp"
#include "notation/latex_names.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t line_width = 335;        ///< points; the text of an `article` in 10 pt is 345 wide
constexpr std::size_t indent = 10;             ///< points, of \quad
constexpr std::size_t longest_latex = 100'000; ///< nodes; a shared tree may be exponentially long when written out

/// How tightly a text holds together, loosest first.
enum class LatexHold { sum, sign, product, power, atom };

struct LatexPiece {
    std::string text;
    LatexHold hold;
};

class LatexWriter {
  public:
    explicit LatexWriter(const LatexNames& names) : names_(names) {}

    /// `last`: no factor stands behind it, which a sine without parentheses would take in.
    std::string write(const Tree& tree, LatexHold at_least, bool last = true)
    {
        const LatexPiece piece = write_piece(tree, last);
        return piece.hold >= at_least ? piece.text : "\\left(" + piece.text + "\\right)";
    }

  private:
    LatexPiece write_piece(const Tree& tree, bool last)
    {
        written_ += 1;
        if (written_ > longest_latex) return {"\\dots", LatexHold::atom};
        switch (tree->kind) {
        case TreeKind::number: return write_number(tree->number);
        case TreeKind::pi: return {"\\pi", LatexHold::atom};
        case TreeKind::name:
            return {tree->name[0] == rate_mark ? names_.dotted(tree->name.substr(1)) : names_.symbol(tree->name),
                    LatexHold::power};
        case TreeKind::sum_over: return write_indexed_sum(tree, last);
        case TreeKind::negate: return {"-" + write(tree->arguments[0], LatexHold::product, last), LatexHold::sign};
        case TreeKind::add: return write_sum(tree);
        case TreeKind::multiply: return write_product(tree, last);
        case TreeKind::divide:
            return {"\\frac{" + write(tree->arguments[0], LatexHold::sum) + "}{" +
                        write(tree->arguments[1], LatexHold::sum) + "}",
                    LatexHold::product};
        case TreeKind::power: return write_power(tree, last);
        case TreeKind::call: return write_call(tree, last);
        case TreeKind::solve: return write_solve(tree);
        case TreeKind::compare: return write_comparison(tree);
        case TreeKind::apply: return write_vector_product(tree);
        default: break;
        }
        return {"\\dots", LatexHold::atom};
    }

    static LatexPiece write_number(const Rational& value)
    {
        if (value.get_den() == 1) return {value.get_str(), value < 0 ? LatexHold::sign : LatexHold::atom};
        const std::string fraction =
            "\\frac{" + Rational(abs(value)).get_num().get_str() + "}{" + value.get_den().get_str() + "}";
        return {(value < 0 ? "-" : "") + fraction, value < 0 ? LatexHold::sign : LatexHold::product};
    }

    /// sin^2(x) rather than (sin(x))^2.
    LatexPiece write_power(const Tree& tree, bool last)
    {
        const std::string exponent = "^{" + write(tree->arguments[1], LatexHold::sum) + "}";
        if (!raised_by_name(tree)) return {write_base(tree->arguments[0]) + exponent, LatexHold::power};
        const Tree& call = tree->arguments[0];
        return {entry_of(call->function).latex + exponent + write_argument(call->arguments[0], last), LatexHold::power};
    }

    /// Of a circular or hyperbolic function: a symbol stands without parentheses, sin x.
    std::string write_argument(const Tree& argument, bool last)
    {
        const std::string text = write(argument, LatexHold::sum);
        return argument->kind == TreeKind::name && last ? " " + text : "\\left(" + text + "\\right)";
    }

    static bool begins_with_function(const Tree& tree)
    {
        const Tree& base = tree->kind == TreeKind::power ? tree->arguments[0] : tree;
        return base->kind == TreeKind::call && entry_of(base->function).raised_by_name;
    }

    /// A symbol may be raised although it is no atom: its own subscript stays below.
    std::string write_base(const Tree& tree)
    {
        return tree->kind == TreeKind::name ? names_.raisable(tree->name) : write(tree, LatexHold::atom);
    }

    LatexPiece write_sum(const Tree& tree)
    {
        std::string text;
        for (const Tree& argument : tree->arguments) {
            const SignedTree term = without_sign(argument);
            text += text.empty() ? (term.negative ? "-" : "") : (term.negative ? " - " : " + ");
            text += write(term.tree, LatexHold::product);
        }
        return {text, LatexHold::sum};
    }

    LatexPiece write_product(const Tree& tree, bool last)
    {
        std::string text;
        const std::vector<Tree>& factors = tree->arguments;
        for (std::size_t k = 0; k < factors.size(); ++k) {
            const bool ends = k + 1 == factors.size() ? last : begins_with_function(factors[k + 1]);
            const bool open = k + 1 < factors.size() && (is_vector_product(factors[k]) || is_indexed_sum(factors[k]));
            text += (text.empty() ? "" : "\\, ") + (open ? "\\left(" + write(factors[k], LatexHold::sum) + "\\right)"
                                                         : write(factors[k], LatexHold::product, ends));
        }
        return {text, LatexHold::product};
    }

    /// \sum_{j=1, j \neq i}^{4} body
    LatexPiece write_indexed_sum(const Tree& tree, bool last)
    {
        const auto bound = [](const Tree& index) {
            return index->name.starts_with("max(") ? "\\" + index->name : index->name;
        };
        const std::vector<Tree>& parts = tree->arguments;
        std::string text = "\\sum_{" + tree->name + "=" + bound(parts[0]);
        if (parts.size() > 3) text += ",\\, " + tree->name + " \\neq " + bound(parts[3]);
        return {text + "}^{" + bound(parts[1]) + "} " + write(parts[2], LatexHold::product, last), LatexHold::product};
    }

    LatexPiece write_vector_product(const Tree& tree)
    {
        std::string text;
        for (const Tree& argument : tree->arguments)
            text += (text.empty()            ? ""
                     : tree->name == "cross" ? " \\times "
                                             : " \\cdot ") +
                    (is_vector_product(argument) ? "\\left(" + write(argument, LatexHold::sum) + "\\right)"
                                                 : write(argument, LatexHold::product));
        return {text, LatexHold::product};
    }

    LatexPiece write_call(const Tree& tree, bool last)
    {
        if (begins_with_function(tree))
            return {entry_of(tree->function).latex + write_argument(tree->arguments[0], last), LatexHold::power};
        const std::string first = write(tree->arguments[0], LatexHold::sum);
        if (tree->function == Function::sqrt) return {"\\sqrt{" + first + "}", LatexHold::atom};
        if (tree->function == Function::stumpff)
            return {"c_{" + first + "}\\left(" + write(tree->arguments[1], LatexHold::sum) + "\\right)",
                    LatexHold::power};
        if (tree->function == Function::abs) return {"\\left|" + first + "\\right|", LatexHold::atom};
        std::string text = entry_of(tree->function).latex + ("\\left(" + first);
        for (std::size_t k = 1; k < tree->arguments.size(); ++k)
            text += ", " + write(tree->arguments[k], LatexHold::sum);
        return {text + "\\right)", LatexHold::power};
    }

    /// Component k of A^{-1} b, counted from 1.
    LatexPiece write_solve(const Tree& tree)
    {
        const std::size_t n = solve_order(tree->arguments.size());
        std::string matrix;
        std::string right;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j)
                matrix += (j != 0 ? " & " : i != 0 ? " \\\\ " : "") + write(tree->arguments[i * n + j], LatexHold::sum);
            right += (i != 0 ? " \\\\ " : "") + write(tree->arguments[n * n + i], LatexHold::sum);
        }
        return {"\\left(\\begin{pmatrix} " + matrix + " \\end{pmatrix}^{-1} \\begin{pmatrix} " + right +
                    " \\end{pmatrix}\\right)_{" + Rational(tree->number + 1).get_str() + "}",
                LatexHold::power};
    }

    LatexPiece write_comparison(const Tree& tree)
    {
        static constexpr const char* signs[] = {" < ", " \\le ", " > ", " \\ge ", " = ", " \\ne "};
        return {write(tree->arguments[0], LatexHold::sum) + signs[static_cast<std::size_t>(tree->comparison)] +
                    write(tree->arguments[1], LatexHold::sum),
                LatexHold::sum};
    }

    const LatexNames& names_;
    std::size_t written_ = 0;
};

/// How wide our own LaTeX comes out in points at 10 pt, near enough to break lines by.
class WidthMeter {
  public:
    explicit WidthMeter(std::string_view text) : text_(text) {}

    /// Up to the end of the text or of the group.
    std::size_t measure()
    {
        std::size_t width = 0;
        while (at_ < text_.size() && text_[at_] != '}') width += measure_item();
        return width;
    }

  private:
    std::size_t measure_item()
    {
        const char c = text_[at_];
        if (c == '\\') return measure_command();
        ++at_;
        switch (c) {
        case '{': {
            const std::size_t width = measure();
            at_ += at_ < text_.size() ? 1 : 0;
            return width;
        }
        case '^':
        case '_': return at_ < text_.size() ? measure_item() * 7 / 10 : 0;
        case ' ': return 0;
        case '+':
        case '-':
        case '=': return 12;
        case '(':
        case ')': return 4;
        default: return begins_character(c) ? 6 : 0;
        }
    }

    std::size_t measure_command()
    {
        const std::size_t begin = ++at_;
        while (at_ < text_.size() &&
               ((text_[at_] >= 'a' && text_[at_] <= 'z') || (text_[at_] >= 'A' && text_[at_] <= 'Z')))
            ++at_;
        const std::string_view word = text_.substr(begin, at_ - begin);
        if (word.empty()) { // a spacing or an escaped character
            at_ += at_ < text_.size() ? 1 : 0;
            return 2;
        }
        if (word == "frac") {
            const std::size_t numerator = measure_item();
            return std::max(numerator, at_ < text_.size() ? measure_item() : 0) + 2;
        }
        static constexpr std::string_view silent[] = {"left",   "right",  "dot",          "ddot",
                                                      "mathit", "mathrm", "operatorname", "text"};
        if (std::find(std::begin(silent), std::end(silent), word) != std::end(silent)) return 0;
        static constexpr std::string_view spelled[] = {"sin",  "cos",  "tan", "arcsin", "arccos", "arctan", "sinh",
                                                       "cosh", "tanh", "exp", "log",    "min",    "max"};
        return std::find(std::begin(spelled), std::end(spelled), word) != std::end(spelled) ? 5 * word.size() : 6;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

std::size_t typeset_width(std::string_view text)
{
    return WidthMeter(text).measure();
}

std::string left_side(const Equation& equation, const LatexNames& names)
{
    if (equation.left == LeftSide::zero) return "0";
    if (equation.left == LeftSide::symbol) return names.symbol(equation.symbol);
    if (equation.left == LeftSide::differential) return "d" + names.symbol(equation.symbol);
    if (equation.left == LeftSide::form) return "de^{" + names.symbol(equation.symbol) + "}";
    if (equation.left == LeftSide::bracket)
        return "\\{" + names.symbol(equation.symbol) + ", " + names.symbol(equation.other) + "\\}";
    if (equation.left == LeftSide::section) return "e_{" + names.symbol(equation.symbol) + "}";
    if (equation.left == LeftSide::commutator)
        return "[e_{" + names.symbol(equation.symbol) + "}, e_{" + names.symbol(equation.other) + "}]";
    std::vector<std::string> symbols;
    for (const std::string& name : equation.arguments) symbols.push_back(names.symbol(name));
    if (equation.left == LeftSide::component) return names.symbol(equation.symbol) + "(" + joined(symbols) + ")";
    if (equation.mass.empty()) return names.dotted(equation.symbol);
    std::string text;
    for (const TermGroup& entry : equation.mass) {
        const SignedTree mass = without_sign(entry.value);
        if (entry.label.empty()) {
            text += text.empty() ? (mass.negative ? "-" : "") : (mass.negative ? " - " : " + ");
            text += LatexWriter(names).write(mass.tree, LatexHold::product);
            continue;
        }
        text += text.empty() ? (mass.negative ? "-" : "") : (mass.negative ? " - " : " + ");
        text += (is_one(mass.tree) ? "" : LatexWriter(names).write(mass.tree, LatexHold::product, false) + "\\, ") +
                names.dotted(entry.label);
    }
    return text;
}

const char* relation_latex(Relation relation)
{
    return relation == Relation::equal ? " &= " : relation == Relation::at_least ? " &\\geq " : " &\\leq ";
}

std::string latex_of_term(const SignedTree& term, const LatexNames& names, bool of_sections)
{
    if (term.basis.empty()) return LatexWriter(names).write(term.tree, LatexHold::product);
    std::string wedge;
    for (const std::string& name : term.basis)
        wedge += (of_sections ? "e_{" : wedge.empty() ? "e^{" : " \\wedge e^{") + names.symbol(name) + "}";
    return (is_one(term.tree) ? "" : LatexWriter(names).write(term.tree, LatexHold::product, false) + "\\, ") + wedge;
}

/// The values of indices, behind an equation.
std::string ranges_latex(const std::vector<IndexRange>& ranges)
{
    std::string text;
    for (const IndexRange& range : ranges)
        text += (text.empty() ? " \\qquad (" : ", \\; ") + range.letter + " = " + std::to_string(range.from) +
                ", \\dots, " + std::to_string(range.to);
    return text + (text.empty() ? "" : ")");
}

void print_block(std::string& text, const EquationBlock& block, const LatexNames& names)
{
    text += "\\paragraph{" + escape_latex(block.title) + "} $" + block.latex_formula + "$\n\\begin{align*}\n";
    std::size_t widest = 0; // the left sides share a column
    const std::vector<Equation>& equations = written_equations(block);
    for (const Equation& equation : equations) widest = std::max(widest, typeset_width(left_side(equation, names)));
    const std::size_t margin = std::min(widest, line_width / 2) + 12;
    for (std::size_t e = 0; e < equations.size(); ++e) {
        const Equation& equation = equations[e];
        std::vector<std::pair<bool, std::string>> terms;
        const bool of_sections = equation.left == LeftSide::section || equation.left == LeftSide::commutator;
        for (const SignedTree& term : right_side_terms(equation))
            terms.emplace_back(term.negative, latex_of_term(term, names, of_sections));
        if (terms.empty()) terms.emplace_back(false, "0");
        terms.back().second += ranges_latex(equation.ranges);
        text += "  " + left_side(equation, names) + relation_latex(equation.relation);
        const std::vector<std::string> lines = wrap_terms(terms, margin, margin + indent, line_width, typeset_width);
        for (std::size_t k = 0; k < lines.size(); ++k) text += (k == 0 ? "" : " \\\\\n  &\\quad ") + lines[k];
        text += e + 1 < equations.size() ? " \\\\\n" : "\n";
    }
    text += "\\end{align*}\n";
}

/// What symbols stand for; vectors as vectors.
void print_where(std::string& text, const EquationSet& equations, const LatexNames& names)
{
    const std::vector<WhereItem> items = where_items(equations);
    if (items.empty()) return;
    text += "\\paragraph{where}\n\\begin{align*}\n";
    std::size_t widest = 0;
    for (const WhereItem& item : items) widest = std::max(widest, typeset_width(names.symbol(item.symbol)));
    const std::size_t margin = std::min(widest, line_width / 2) + 12;
    for (std::size_t e = 0; e < items.size(); ++e) {
        std::vector<std::string> lines;
        if (items[e].values.size() == 1) {
            std::vector<std::pair<bool, std::string>> terms;
            for (const SignedTree& term : right_side_terms({LeftSide::symbol, {}, {}, {{"", items[e].values[0]}}}))
                terms.emplace_back(term.negative, latex_of_term(term, names, false));
            terms.back().second += ranges_latex(items[e].ranges);
            lines = wrap_terms(terms, margin, margin + indent, line_width, typeset_width);
        } else {
            std::vector<std::string> entries;
            for (const Tree& value : items[e].values)
                entries.push_back(LatexWriter(names).write(value, LatexHold::sum));
            lines = wrap_entries(entries, items[e].diagonal ? "\\operatorname{diag}(" : "(", ")", margin,
                                 margin + indent, line_width, typeset_width);
        }
        text += "  " + names.symbol(items[e].symbol) + " &= ";
        for (std::size_t k = 0; k < lines.size(); ++k) text += (k == 0 ? "" : " \\\\\n  &\\quad ") + lines[k];
        text += e + 1 < items.size() ? " \\\\\n" : "\n";
    }
    text += "\\end{align*}\n";
}

} // namespace

std::string latex_of(const Tree& tree, const EquationSet& symbols)
{
    return LatexWriter(LatexNames(symbols.symbols)).write(tree, LatexHold::sum);
}

std::string print_latex(const EquationSet& equations)
{
    const LatexNames names(equations.symbols);
    std::string text =
        "\\subsection*{" + escape_latex(equations.title.empty() ? equations.model : equations.title) + "}\n";
    for (const auto* blocks : {&equations.given, &equations.blocks})
        for (const EquationBlock& block : *blocks)
            if (!block.equations.empty()) print_block(text, block, names);
    print_where(text, equations, names);
    if (!equations.statements.empty()) text += "\\paragraph{statements}\n\\begin{itemize}\n";
    for (const DecidedStatement& statement : equations.statements)
        text += "  \\item $" + statement.latex_formula + "$: " + statement.status + "\n";
    if (!equations.statements.empty()) text += "\\end{itemize}\n";
    return text;
}

} // namespace lagen
