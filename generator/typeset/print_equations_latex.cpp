// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as LaTeX (amsmath), and names as LaTeX symbols.
#include "text/alphabet.hpp"
#include "typeset/equation_writer.hpp"
#include "typeset/latex_names.hpp"
#include "typeset/print_equations.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t text_width = 335; ///< points; the text of an `article` in 10 pt is 345 wide
constexpr std::size_t indent = 10;      ///< points, of \quad
/// \sum_{j=1, j \neq i}^{4}
std::string sum_sign_latex(const Tree& sum)
{
    const auto bound = [&](std::size_t part) {
        const std::string& index = sum->arguments[part]->name;
        return index.starts_with("max(") ? "\\" + index : index;
    };
    const std::string excluded = sum->arguments.size() > 3 ? ",\\, " + sum->name + " \\neq " + bound(3) : "";
    return "\\sum_{" + sum->name + "=" + bound(0) + excluded + "}^{" + bound(1) + "} ";
}

EquationWriter writer_with(const LatexNames& names)
{
    return EquationWriter({
        .open = "\\left(",
        .close = "\\right)",
        .open_set = "\\{",
        .close_set = "\\}",
        .open_size = "\\left|",
        .close_size = "\\right|",
        .upper = "^{",
        .lower = "_{",
        .end_index = "}",
        .times = "\\, ",
        .cross = " \\times ",
        .dot = " \\cdot ",
        .wedge = " \\wedge ",
        .pi = "\\pi",
        .dots = "\\dots",
        .comparisons = {" < ", " \\le ", " > ", " \\ge ", " = ", " \\ne "},
        .fraction = {"\\frac{", "}{", "}", Hold::sum, Hold::sum, Hold::product},
        .root = {"\\sqrt{", "}", Hold::sum, Hold::atom},
        .matrix = {"\\begin{pmatrix} ", " \\end{pmatrix}", " & ", " \\\\ ", "^{-1}"},
        .ranges = {" \\qquad (", ", \\; ", ", \\dots, "},
        .exponent = Hold::sum,
        .call = Hold::power,
        .script_digits = false,
        .bare_arguments = true,
        .function = &FunctionEntry::latex,
        .sum_sign = sum_sign_latex,
        .symbol = [&](const std::string& name) { return names.symbol(name); },
        .dotted = [&](const std::string& name) { return names.dotted(name); },
        .base = [&](const std::string& name) { return names.raisable(name); },
    });
}

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

const char* relation_latex(Relation relation)
{
    return relation == Relation::equal ? " &= " : relation == Relation::at_least ? " &\\geq " : " &\\leq ";
}

/// An align* environment, a row for each left side with its relation. `right` has the lines of a row behind a margin.
std::string aligned(const std::vector<std::pair<std::string, std::string>>& lefts,
                    const std::function<std::vector<std::string>(std::size_t row, std::size_t margin)>& right)
{
    std::size_t widest = 0; // the left sides share a column
    for (const auto& [left, relation] : lefts) widest = std::max(widest, typeset_width(left));
    std::string text = "\\begin{align*}\n";
    for (std::size_t row = 0; row < lefts.size(); ++row) {
        text += "  " + lefts[row].first + lefts[row].second;
        const std::vector<std::string> lines = right(row, std::min(widest, text_width / 2) + 12);
        for (std::size_t k = 0; k < lines.size(); ++k) text += (k == 0 ? "" : " \\\\\n  &\\quad ") + lines[k];
        text += row + 1 < lefts.size() ? " \\\\\n" : "\n";
    }
    return text + "\\end{align*}\n";
}

std::vector<std::string> lines_of(const SignedTexts& terms, std::size_t margin)
{
    return wrap_terms(terms, margin, margin + indent, text_width, typeset_width);
}

std::string block_text(const EquationBlock& block, const EquationWriter& writer)
{
    const std::vector<Equation>& equations = written_equations(block);
    std::vector<std::pair<std::string, std::string>> lefts;
    for (const Equation& equation : equations)
        lefts.emplace_back(writer.left_side(equation), relation_latex(equation.relation));
    return "\\paragraph{" + escape_latex(block.title) + "} $" + block.latex_formula + "$\n" +
           aligned(lefts, [&](std::size_t row, std::size_t margin) {
               return lines_of(writer.right_terms(equations[row]), margin);
           });
}

/// The symbols with what they stand for; vectors as vectors.
std::string where_text(const EquationSet& equations, const LatexNames& names, const EquationWriter& writer)
{
    const std::vector<WhereItem> items = where_items(equations);
    if (items.empty()) return "";
    std::vector<std::pair<std::string, std::string>> lefts;
    for (const WhereItem& item : items) lefts.emplace_back(names.symbol(item.symbol), relation_latex(Relation::equal));
    return "\\paragraph{where}\n" + aligned(lefts, [&](std::size_t row, std::size_t margin) {
               const WhereItem& item = items[row];
               if (item.values.size() == 1) return lines_of(writer.terms_of(item), margin);
               return wrap_entries(writer.entries_of(item), item.diagonal ? "\\operatorname{diag}(" : "(", ")", margin,
                                   margin + indent, text_width, typeset_width);
           });
}

} // namespace

std::string latex_of(const Tree& tree, const EquationSet& symbols)
{
    const LatexNames names(symbols.symbols);
    return writer_with(names).write(tree, Hold::sum);
}

std::string print_latex(const EquationSet& equations)
{
    const LatexNames names(equations.symbols);
    const EquationWriter writer = writer_with(names);
    std::string text =
        "\\subsection*{" + escape_latex(equations.title.empty() ? equations.model : equations.title) + "}\n";
    for (const auto* blocks : {&equations.given, &equations.blocks})
        for (const EquationBlock& block : *blocks)
            if (!written_equations(block).empty()) text += block_text(block, writer);
    text += where_text(equations, names, writer);
    if (!equations.statements.empty()) text += "\\paragraph{statements}\n\\begin{itemize}\n";
    for (const DecidedStatement& statement : equations.statements)
        text += "  \\item $" + statement.latex_formula + "$: " + statement.status + "\n";
    if (!equations.statements.empty()) text += "\\end{itemize}\n";
    return text;
}

} // namespace lagen
