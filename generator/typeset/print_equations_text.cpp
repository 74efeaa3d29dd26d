// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as UTF-8 text: products by a space, powers raised, a dot over the letter of a name such as x or w1 and
/// d/dt before any other.
#include "text/alphabet.hpp"
#include "text/comma_list.hpp"
#include "text/diagnostic.hpp"
#include "typeset/equation_writer.hpp"
#include "typeset/print_equations.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t page_width = 120;
constexpr std::size_t widest_left = page_width / 2; ///< of a left side beside its right side

/// One letter, of ASCII or Greek, alone or before digits and subscripts: the names that bear a dot well.
bool bears_dot(const std::string& name)
{
    const CodePoint first = decode_utf8(name, 0);
    const bool letter = first.value < 0x80 ? is_letter(first.value) : first.value >= 0x380 && first.value < 0x400;
    const char next = name.size() > first.length ? name[first.length] : '_';
    return letter && (next == '_' || next == '[' || is_digit(next));
}

std::string dotted(const std::string& name)
{
    return bears_dot(name) ? with_dot(name) : "d/dt " + name;
}

/// Σ_{j=1..4, j≠i}
std::string sum_sign_text(const Tree& sum)
{
    const std::vector<Tree>& parts = sum->arguments;
    const std::string excluded = parts.size() > 3 ? ", " + sum->name + "≠" + parts[3]->name : "";
    return "Σ_{" + sum->name + "=" + parts[0]->name + ".." + parts[1]->name + excluded + "} ";
}

const EquationWriter& writer()
{
    const auto as_it_is = [](const std::string& name) { return name; };
    static const EquationWriter text({
        .open = "(",
        .close = ")",
        .open_set = "{",
        .close_set = "}",
        .open_size = "|",
        .close_size = "|",
        .upper = "^",
        .lower = "_",
        .end_index = "",
        .times = " ",
        .cross = " × ",
        .dot = " · ",
        .wedge = "∧",
        .pi = "π",
        .dots = "...",
        .comparisons = {" < ", " ≤ ", " > ", " ≥ ", " = ", " ≠ "},
        .fraction = {"", "/", "", Hold::product, Hold::power, Hold::quotient},
        .root = {"√", "", Hold::atom, Hold::power},
        .matrix = {"[", "]", ", ", "; ", "⁻¹"},
        .ranges = {"   (", ", ", ".."},
        .exponent = Hold::atom,
        .call = Hold::atom,
        .script_digits = true,
        .bare_arguments = false,
        .function = &FunctionEntry::name,
        .sum_sign = sum_sign_text,
        .symbol = as_it_is,
        .dotted = dotted,
        .base = as_it_is,
    });
    return text;
}

const char* relation_text(Relation relation)
{
    return relation == Relation::equal ? " = " : relation == Relation::at_least ? " ≥ " : " ≤ ";
}

/// The first line where the text ends, the others behind a margin.
void append_lines(std::string& text, const std::vector<std::string>& lines, std::size_t margin)
{
    for (std::size_t k = 0; k < lines.size(); ++k) text += (k == 0 ? "" : std::string(margin, ' ')) + lines[k] + "\n";
}

/// Lines within the page, the first behind `first` columns, the others behind `margin`.
std::vector<std::string> page_lines(const SignedTexts& terms, std::size_t first, std::size_t margin,
                                    LongLines long_lines)
{
    if (long_lines == LongLines::whole) return wrap_terms(terms, first, margin, page_width, columns_of);
    return with_inner_breaks(wrap_terms(terms, first, margin, page_width, columns_of), first, margin, page_width);
}

/// True of a long left side, which stands on lines of its own, the right side below.
bool stands_apart(const Equation& equation, LongLines long_lines)
{
    const std::size_t columns = columns_of(writer().left_side(equation));
    return long_lines == LongLines::broken && !equation.mass.empty() && columns > widest_left &&
           page_lines(writer().right_terms(equation), columns + 5, 0, long_lines).size() > 1;
}

void print_block(std::string& text, const EquationBlock& block, LongLines long_lines)
{
    const bool fits = columns_of(block.title) + 3 + columns_of(block.formula) <= page_width;
    text += "\n" + block.title + (fits ? ":  " : ":\n  ") + block.formula + "\n";
    std::size_t widest = 0; // of the left sides that share a column
    const std::vector<Equation>& equations = written_equations(block);
    for (const Equation& equation : equations)
        if (!stands_apart(equation, long_lines)) widest = std::max(widest, columns_of(writer().left_side(equation)));
    widest = std::min(widest, widest_left);
    for (const Equation& equation : equations) {
        if (stands_apart(equation, long_lines)) {
            text += "  ";
            append_lines(text, page_lines(writer().mass_terms(equation), 2, 4, long_lines), 4);
            text += "    " + std::string(relation_text(equation.relation) + 1);
            append_lines(text, page_lines(writer().right_terms(equation), 6, 6, long_lines), 6);
            continue;
        }
        const std::string left = writer().left_side(equation);
        const std::size_t columns = columns_of(left);
        text +=
            "  " + std::string(columns < widest ? widest - columns : 0, ' ') + left + relation_text(equation.relation);
        const std::size_t margin = widest + 5;
        append_lines(text,
                     page_lines(writer().right_terms(equation), std::max(columns, widest) + 5, margin, long_lines),
                     margin);
    }
}

/// Lists symbols with their values; vectors as vectors.
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
            lines = page_lines(writer().terms_of(item), margin, margin, long_lines);
        } else {
            lines = wrap_entries(writer().entries_of(item), item.diagonal ? "diag(" : "[", item.diagonal ? ")" : "]",
                                 margin, margin + 1, page_width, columns_of);
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
    return residual.size() <= room ? residual : whole_characters(residual, room - 3) + "...";
}

void print_statement(std::string& text, const DecidedStatement& statement)
{
    text += "  " + statement.status + std::string(11 - statement.status.size(), ' ') + statement.formula + "\n";
    const std::string margin(13, ' ');
    if (!statement.residual.empty() && statement.status != "proved") {
        text += margin + "residual";
        if (!statement.component.empty()) text += "(" + comma_list(statement.component) + ")";
        text += " " + on_one_line(statement.residual) + "\n";
    }
    std::vector<std::string> point;
    for (const auto& [name, value] : statement.witness) point.push_back(name + " = " + value);
    if (!point.empty()) text += fmt::format("{}at {}: {:.17g}\n", margin, comma_list(point), statement.value);
    if (!statement.evidence.empty()) text += margin + "known: " + statement.evidence + "\n";
}

} // namespace

std::string print_text(const EquationSet& equations, LongLines long_lines)
{
    std::string text = (equations.title.empty() ? equations.model : equations.title) + "\n";
    for (const auto* blocks : {&equations.given, &equations.blocks})
        for (const EquationBlock& block : *blocks)
            if (!written_equations(block).empty()) print_block(text, block, long_lines);
    print_where(text, equations, long_lines);
    if (!equations.statements.empty()) text += "\nstatements:\n";
    for (const DecidedStatement& statement : equations.statements) print_statement(text, statement);
    return text;
}

} // namespace lagen
