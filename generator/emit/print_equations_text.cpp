// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as UTF-8 text: products by a space, powers raised, a dot over the letter of a name such as x or w1 and
/// d/dt before any other.
#include "emit/print_equations.hpp"
#include "emit/print_equations_terms.hpp"
#include "emit/text_block.hpp"
#include "expression/alphabet.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t page_width = 120;
constexpr std::size_t widest_left = page_width / 2; ///< of a left side beside its right side
constexpr std::size_t longest_text = 100'000;       ///< bytes; a shared tree may be exponentially long when written out

/// How tightly a text holds together, loosest first.
enum class TextHold { sum, sign, quotient, product, power, atom };

struct TextPiece {
    std::string text;
    TextHold hold;
};

std::string dotted(const std::string& name);

class TextWriter {
  public:
    std::string write(const Tree& tree, TextHold at_least)
    {
        const TextPiece piece = write_piece(tree);
        return piece.hold >= at_least ? piece.text : "(" + piece.text + ")";
    }

  private:
    TextPiece write_piece(const Tree& tree)
    {
        written_ += 1;
        if (written_ > longest_text) return {"...", TextHold::atom};
        switch (tree->kind) {
        case TreeKind::number: return write_number(tree->number);
        case TreeKind::pi: return {"π", TextHold::atom};
        case TreeKind::name:
            return {tree->name[0] == rate_mark ? dotted(tree->name.substr(1)) : tree->name, TextHold::atom};
        case TreeKind::sum_over: return write_indexed_sum(tree);
        case TreeKind::negate: return {"-" + write(tree->arguments[0], TextHold::quotient), TextHold::sign};
        case TreeKind::add: return write_sum(tree);
        case TreeKind::multiply: return write_product(tree);
        case TreeKind::divide:
            return {write(tree->arguments[0], TextHold::product) + "/" + write(tree->arguments[1], TextHold::power),
                    TextHold::quotient};
        case TreeKind::power: return write_power(tree);
        case TreeKind::call: return write_call(tree);
        case TreeKind::solve: return write_solve(tree);
        case TreeKind::apply: return write_vector_product(tree);
        case TreeKind::compare: return write_comparison(tree);
        default: break;
        }
        return {to_text(tree), TextHold::sum};
    }

    static TextPiece write_number(const Rational& value)
    {
        const TextHold hold = value < 0 ? TextHold::sign : value.get_den() == 1 ? TextHold::atom : TextHold::quotient;
        return {value.get_str(), hold};
    }

    TextPiece write_sum(const Tree& tree)
    {
        std::string text;
        for (const Tree& argument : tree->arguments) {
            const SignedTree term = without_sign(argument);
            text += text.empty() ? (term.negative ? "-" : "") : (term.negative ? " - " : " + ");
            text += write(term.tree, TextHold::quotient);
        }
        return {text, TextHold::sum};
    }

    /// A sum over an index takes in what stands behind it; as the last factor it needs no parentheses.
    TextPiece write_product(const Tree& tree)
    {
        std::string text;
        const Tree& last = tree->arguments.back();
        for (const Tree& factor : tree->arguments)
            text += (text.empty() ? "" : " ") +
                    (is_vector_product(factor) && factor != last ? "(" + write(factor, TextHold::sum) + ")"
                     : is_indexed_sum(factor) && factor == last  ? write(factor, TextHold::quotient)
                                                                 : write(factor, TextHold::product));
        return {text, is_indexed_sum(last) ? TextHold::quotient : TextHold::product};
    }

    /// Σ_{j=1..4, j≠i} body
    TextPiece write_indexed_sum(const Tree& tree)
    {
        const std::vector<Tree>& parts = tree->arguments;
        std::string text = "Σ_{" + tree->name + "=" + parts[0]->name + ".." + parts[1]->name;
        if (parts.size() > 3) text += ", " + tree->name + "≠" + parts[3]->name;
        return {text + "} " + write(parts[2], TextHold::quotient), TextHold::quotient};
    }

    /// a × b and a · b
    TextPiece write_vector_product(const Tree& tree)
    {
        std::string text;
        for (const Tree& argument : tree->arguments)
            text += (text.empty()            ? ""
                     : tree->name == "cross" ? " × "
                                             : " · ") +
                    (is_vector_product(argument) ? "(" + write(argument, TextHold::sum) + ")"
                                                 : write(argument, TextHold::product));
        return {text, TextHold::product};
    }

    TextPiece write_power(const Tree& tree)
    {
        const Tree& exponent = tree->arguments[1];
        if (raised_by_name(tree)) {
            const Tree& call = tree->arguments[0];
            return {entry_of(call->function).name + raised_digits(exponent->number.get_str()) + "(" +
                        write(call->arguments[0], TextHold::sum) + ")",
                    TextHold::power};
        }
        const std::string base = write(tree->arguments[0], TextHold::atom);
        if (exponent->kind == TreeKind::number && exponent->number.get_den() == 1)
            return {base + raised_digits(exponent->number.get_str()), TextHold::power};
        return {base + "^" + write(exponent, TextHold::atom), TextHold::power};
    }

    TextPiece write_call(const Tree& tree)
    {
        if (tree->function == Function::sqrt) return {"√" + write(tree->arguments[0], TextHold::atom), TextHold::power};
        if (tree->function == Function::stumpff)
            return {"c" + lowered_digits(to_text(tree->arguments[0])) + "(" + write(tree->arguments[1], TextHold::sum) +
                        ")",
                    TextHold::atom};
        if (tree->function == Function::abs)
            return {"|" + write(tree->arguments[0], TextHold::sum) + "|", TextHold::atom};
        std::string text = entry_of(tree->function).name;
        for (std::size_t k = 0; k < tree->arguments.size(); ++k)
            text += (k == 0 ? "(" : ", ") + write(tree->arguments[k], TextHold::sum);
        return {text + ")", TextHold::atom};
    }

    /// ([a, b; c, d]⁻¹ [e; f])₁: component 1 of the solution.
    TextPiece write_solve(const Tree& tree)
    {
        const std::size_t n = solve_order(tree->arguments.size());
        std::string matrix;
        std::string right;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j)
                matrix += (j != 0 ? ", " : i != 0 ? "; " : "") + write(tree->arguments[i * n + j], TextHold::sum);
            right += (i != 0 ? "; " : "") + write(tree->arguments[n * n + i], TextHold::sum);
        }
        const std::string component = Rational(tree->number + 1).get_str();
        return {"([" + matrix + "]⁻¹ [" + right + "])" + lowered_digits(component), TextHold::atom};
    }

    TextPiece write_comparison(const Tree& tree)
    {
        static constexpr const char* signs[] = {" < ", " ≤ ", " > ", " ≥ ", " = ", " ≠ "};
        return {write(tree->arguments[0], TextHold::sum) + signs[static_cast<std::size_t>(tree->comparison)] +
                    write(tree->arguments[1], TextHold::sum),
                TextHold::sum};
    }

    std::size_t written_ = 0;
};

/// One ASCII letter, alone or before digits and subscripts: the names that bear a dot well.
bool bears_dot(const std::string& name)
{
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (name.empty()) return false;
    const auto first = static_cast<unsigned char>(name[0]);
    const auto begins_index = [](char c) { return c == '_' || c == '[' || (c >= '0' && c <= '9'); };
    if (first >= 0xCE && first <= 0xCF && name.size() >= 2) // Greek
        return name.size() == 2 || begins_index(name[2]);
    return letter(name[0]) && (name.size() == 1 || begins_index(name[1]));
}

std::string dotted(const std::string& name)
{
    return bears_dot(name) ? with_dot(name) : "d/dt " + name;
}

std::vector<std::pair<bool, std::string>> mass_terms(const Equation& equation)
{
    std::vector<std::pair<bool, std::string>> terms;
    for (const TermGroup& entry : equation.mass) {
        const SignedTree mass = without_sign(entry.value);
        if (entry.label.empty()) {
            terms.emplace_back(mass.negative, TextWriter().write(mass.tree, TextHold::quotient));
            continue;
        }
        const std::string factor = is_one(mass.tree) ? "" : TextWriter().write(mass.tree, TextHold::product) + " ";
        terms.emplace_back(mass.negative, factor + dotted(entry.label));
    }
    return terms;
}

std::string left_side(const Equation& equation)
{
    if (equation.left == LeftSide::zero) return "0";
    if (equation.left == LeftSide::symbol) return equation.symbol;
    if (equation.left == LeftSide::differential) return "d" + equation.symbol;
    if (equation.left == LeftSide::form) return "de^" + equation.symbol;
    if (equation.left == LeftSide::bracket) return "{" + equation.symbol + ", " + equation.other + "}";
    if (equation.left == LeftSide::section) return "e_" + equation.symbol;
    if (equation.left == LeftSide::commutator) return "[e_" + equation.symbol + ", e_" + equation.other + "]";
    if (equation.left == LeftSide::component) return equation.symbol + "(" + joined(equation.arguments) + ")";
    if (equation.mass.empty()) return dotted(equation.symbol);
    std::string text;
    for (const auto& [negative, term] : mass_terms(equation))
        text += (text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ")) + term;
    return text;
}

const char* relation_text(Relation relation)
{
    return relation == Relation::equal ? " = " : relation == Relation::at_least ? " ≥ " : " ≤ ";
}

bool is_of_sections(const Equation& equation)
{
    return equation.left == LeftSide::section || equation.left == LeftSide::commutator;
}

std::string text_of_term(const SignedTree& term, bool of_sections)
{
    if (term.basis.empty()) return TextWriter().write(term.tree, TextHold::quotient);
    std::string wedge;
    for (const std::string& name : term.basis) wedge += (of_sections ? "e_" : wedge.empty() ? "e^" : "∧e^") + name;
    return (is_one(term.tree) ? "" : TextWriter().write(term.tree, TextHold::product) + " ") + wedge;
}

/// The first line where the text ends, the others behind a margin.
void append_lines(std::string& text, const std::vector<std::string>& lines, std::size_t margin)
{
    for (std::size_t k = 0; k < lines.size(); ++k) text += (k == 0 ? "" : std::string(margin, ' ')) + lines[k] + "\n";
}

std::string ranges_text(const std::vector<IndexRange>& ranges)
{
    std::string text;
    for (const IndexRange& range : ranges)
        text += fmt::format("{}{} = {}..{}", text.empty() ? "" : ", ", range.letter, range.from, range.to);
    return text;
}

std::vector<std::pair<bool, std::string>> right_terms(const Equation& equation)
{
    std::vector<std::pair<bool, std::string>> terms;
    for (const SignedTree& term : right_side_terms(equation))
        terms.emplace_back(term.negative, text_of_term(term, is_of_sections(equation)));
    if (terms.empty()) terms.emplace_back(false, "0");
    if (!equation.ranges.empty()) terms.back().second += "   (" + ranges_text(equation.ranges) + ")";
    return terms;
}

/// Lines within the page, the first behind `first` columns, the others behind `margin`.
std::vector<std::string> page_lines(const std::vector<std::pair<bool, std::string>>& terms, std::size_t first,
                                    std::size_t margin, LongLines long_lines)
{
    if (long_lines == LongLines::whole) return wrap_terms(terms, first, margin, page_width, columns_of);
    return with_inner_breaks(wrap_terms(terms, first, margin, page_width, columns_of), first, margin, page_width);
}

/// Whether a long left side stands on lines of its own, the right side below.
bool stands_apart(const Equation& equation, LongLines long_lines)
{
    const std::size_t columns = columns_of(left_side(equation));
    return long_lines == LongLines::broken && !equation.mass.empty() && columns > widest_left &&
           page_lines(right_terms(equation), columns + 5, 0, long_lines).size() > 1;
}

void print_block(std::string& text, const EquationBlock& block, LongLines long_lines)
{
    const bool fits = columns_of(block.title) + 3 + columns_of(block.formula) <= page_width;
    text += "\n" + block.title + (fits ? ":  " : ":\n  ") + block.formula + "\n";
    std::size_t widest = 0; // of the left sides that share a column
    const std::vector<Equation>& equations = written_equations(block);
    for (const Equation& equation : equations)
        if (!stands_apart(equation, long_lines)) widest = std::max(widest, columns_of(left_side(equation)));
    widest = std::min(widest, widest_left);
    for (const Equation& equation : equations) {
        if (stands_apart(equation, long_lines)) {
            text += "  ";
            append_lines(text, page_lines(mass_terms(equation), 2, 4, long_lines), 4);
            text += "    " + std::string(relation_text(equation.relation) + 1);
            append_lines(text, page_lines(right_terms(equation), 6, 6, long_lines), 6);
            continue;
        }
        const std::string left = left_side(equation);
        const std::size_t columns = columns_of(left);
        text +=
            "  " + std::string(columns < widest ? widest - columns : 0, ' ') + left + relation_text(equation.relation);
        const std::size_t margin = widest + 5;
        append_lines(text, page_lines(right_terms(equation), std::max(columns, widest) + 5, margin, long_lines),
                     margin);
    }
}

/// What symbols stand for; vectors as vectors.
void print_where(std::string& text, const EquationSet& equations, LongLines long_lines)
{
    const std::vector<WhereItem> items = where_items(equations);
    if (items.empty()) return;
    text += "\nwhere:\n";
    std::size_t widest = 0;
    for (const WhereItem& item : items) widest = std::max(widest, columns_of(item.symbol));
    const std::size_t margin = widest + 5;
    for (const WhereItem& item : items) {
        std::vector<std::string> lines;
        if (item.values.size() == 1) {
            Equation entry{LeftSide::symbol, {}, {}, {{"", item.values[0]}}};
            entry.ranges = item.ranges;
            lines = page_lines(right_terms(entry), margin, margin, long_lines);
        } else {
            std::vector<std::string> entries;
            for (const Tree& value : item.values) entries.push_back(TextWriter().write(value, TextHold::sum));
            lines = wrap_entries(entries, item.diagonal ? "diag(" : "[", item.diagonal ? ")" : "]", margin, margin + 1,
                                 page_width, columns_of);
            for (std::size_t k = 1; k < lines.size(); ++k) lines[k].insert(0, " ");
        }
        text += "  " + std::string(widest - columns_of(item.symbol), ' ') + item.symbol + " = ";
        append_lines(text, lines, margin);
    }
}

/// A residual, cut where it is long; JSON has it whole.
std::string on_one_line(const std::string& residual)
{
    constexpr std::size_t room = 90;
    return residual.size() <= room ? residual : residual.substr(0, room - 3) + "...";
}

void print_statement(std::string& text, const DecidedStatement& statement)
{
    text += "  " + statement.status + std::string(11 - statement.status.size(), ' ') + statement.formula + "\n";
    const std::string margin(13, ' ');
    if (!statement.residual.empty() && statement.status != "proved") {
        text += margin + "residual";
        if (!statement.component.empty()) text += "(" + joined(statement.component) + ")";
        text += " " + on_one_line(statement.residual) + "\n";
    }
    std::vector<std::string> point;
    for (const auto& [name, value] : statement.witness) point.push_back(name + " = " + value);
    if (!point.empty()) text += fmt::format("{}at {}: {:.17g}\n", margin, joined(point), statement.value);
    if (!statement.evidence.empty()) text += margin + "known: " + statement.evidence + "\n";
}

} // namespace

std::string print_text(const EquationSet& equations, LongLines long_lines)
{
    std::string text = (equations.title.empty() ? equations.model : equations.title) + "\n";
    for (const auto* blocks : {&equations.given, &equations.blocks})
        for (const EquationBlock& block : *blocks)
            if (!block.equations.empty()) print_block(text, block, long_lines);
    print_where(text, equations, long_lines);
    if (!equations.statements.empty()) text += "\nstatements:\n";
    for (const DecidedStatement& statement : equations.statements) print_statement(text, statement);
    return text;
}

} // namespace lagen
