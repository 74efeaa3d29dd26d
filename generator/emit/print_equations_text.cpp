// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as UTF-8 text: products by a space, powers raised, a dot over the letter of a name such as x or w1 and
/// d/dt before any other.
#include "emit/print_equations.hpp"
#include "emit/print_equations_terms.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t page_width = 120;
constexpr std::size_t longest_formula = 100'000; ///< bytes; a shared tree may be exponentially long when written out

/// How tightly a text holds together, loosest first.
enum class Hold { sum, sign, quotient, product, power, atom };

struct Piece {
    std::string text;
    Hold hold;
};

std::string raised_digits(const std::string& digits)
{
    static constexpr const char* raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : digits) text += c == '-' ? "⁻" : raised[c - '0'];
    return text;
}

class TextWriter {
  public:
    std::string write(const Tree& tree, Hold at_least)
    {
        const Piece piece = write_piece(tree);
        return piece.hold >= at_least ? piece.text : "(" + piece.text + ")";
    }

  private:
    Piece write_piece(const Tree& tree)
    {
        written_ += 1;
        if (written_ > longest_formula) return {"...", Hold::atom};
        switch (tree->kind) {
        case TreeKind::number: return write_number(tree->number);
        case TreeKind::pi: return {"π", Hold::atom};
        case TreeKind::name: return {tree->name, Hold::atom};
        case TreeKind::negate: return {"-" + write(tree->arguments[0], Hold::quotient), Hold::sign};
        case TreeKind::add: return write_sum(tree);
        case TreeKind::multiply: return write_product(tree);
        case TreeKind::divide:
            return {write(tree->arguments[0], Hold::product) + "/" + write(tree->arguments[1], Hold::power),
                    Hold::quotient};
        case TreeKind::power: return write_power(tree);
        case TreeKind::call: return write_call(tree);
        default: break;
        }
        return {to_text(tree), Hold::sum};
    }

    static Piece write_number(const Rational& value)
    {
        const Hold hold = value < 0 ? Hold::sign : value.get_den() == 1 ? Hold::atom : Hold::quotient;
        return {value.get_str(), hold};
    }

    Piece write_sum(const Tree& tree)
    {
        std::string text;
        for (const Tree& argument : tree->arguments) {
            const SignedTree term = without_sign(argument);
            text += text.empty() ? (term.negative ? "-" : "") : (term.negative ? " - " : " + ");
            text += write(term.tree, Hold::quotient);
        }
        return {text, Hold::sum};
    }

    Piece write_product(const Tree& tree)
    {
        std::string text;
        for (const Tree& factor : tree->arguments) text += (text.empty() ? "" : " ") + write(factor, Hold::product);
        return {text, Hold::product};
    }

    Piece write_power(const Tree& tree)
    {
        const Tree& exponent = tree->arguments[1];
        if (raised_by_name(tree)) {
            const Tree& call = tree->arguments[0];
            return {entry_of(call->function).name + raised_digits(exponent->number.get_str()) + "(" +
                        write(call->arguments[0], Hold::sum) + ")",
                    Hold::power};
        }
        const std::string base = write(tree->arguments[0], Hold::atom);
        if (exponent->kind == TreeKind::number && exponent->number.get_den() == 1)
            return {base + raised_digits(exponent->number.get_str()), Hold::power};
        return {base + "^" + write(exponent, Hold::atom), Hold::power};
    }

    Piece write_call(const Tree& tree)
    {
        if (tree->function == Function::sqrt) return {"√" + write(tree->arguments[0], Hold::atom), Hold::power};
        if (tree->function == Function::abs) return {"|" + write(tree->arguments[0], Hold::sum) + "|", Hold::atom};
        std::string text = entry_of(tree->function).name;
        for (std::size_t k = 0; k < tree->arguments.size(); ++k)
            text += (k == 0 ? "(" : ", ") + write(tree->arguments[k], Hold::sum);
        return {text + ")", Hold::atom};
    }

    std::size_t written_ = 0;
};

/// One ASCII letter, alone or before digits and subscripts: the names that bear a dot well.
bool bears_dot(const std::string& name)
{
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (name.empty()) return false;
    const auto first = static_cast<unsigned char>(name[0]);
    if (first >= 0xCE && first <= 0xCF && name.size() >= 2) // Greek
        return name.size() == 2 || name[2] == '_' || (name[2] >= '0' && name[2] <= '9');
    return letter(name[0]) && (name.size() == 1 || name[1] == '_' || (name[1] >= '0' && name[1] <= '9'));
}

/// Composed characters where Unicode has them (normal form C), else the letter and a combining dot.
std::string dotted(const std::string& name)
{
    static constexpr std::pair<char, const char*> composed[] = {
        {'a', "ȧ"}, {'b', "ḃ"}, {'c', "ċ"}, {'d', "ḋ"}, {'e', "ė"}, {'f', "ḟ"}, {'g', "ġ"}, {'h', "ḣ"},
        {'m', "ṁ"}, {'n', "ṅ"}, {'o', "ȯ"}, {'p', "ṗ"}, {'r', "ṙ"}, {'s', "ṡ"}, {'t', "ṫ"}, {'w', "ẇ"},
        {'x', "ẋ"}, {'y', "ẏ"}, {'z', "ż"}, {'A', "Ȧ"}, {'B', "Ḃ"}, {'C', "Ċ"}, {'D', "Ḋ"}, {'E', "Ė"},
        {'F', "Ḟ"}, {'G', "Ġ"}, {'H', "Ḣ"}, {'I', "İ"}, {'M', "Ṁ"}, {'N', "Ṅ"}, {'O', "Ȯ"}, {'P', "Ṗ"},
        {'R', "Ṙ"}, {'S', "Ṡ"}, {'T', "Ṫ"}, {'W', "Ẇ"}, {'X', "Ẋ"}, {'Y', "Ẏ"}, {'Z', "Ż"}};
    if (!bears_dot(name)) return "d/dt " + name;
    for (const auto& [letter, text] : composed)
        if (name[0] == letter) return text + name.substr(1);
    const std::size_t size = static_cast<unsigned char>(name[0]) >= 0x80 ? 2 : 1;
    return name.substr(0, size) + "\u0307" + name.substr(size);
}

std::string left_side(const Equation& equation)
{
    if (equation.left == LeftSide::zero) return "0";
    if (equation.left == LeftSide::symbol) return equation.symbol;
    if (equation.mass.empty()) return dotted(equation.symbol);
    std::string text;
    for (const TermGroup& entry : equation.mass) {
        const SignedTree mass = without_sign(entry.value);
        text += text.empty() ? (mass.negative ? "-" : "") : (mass.negative ? " - " : " + ");
        const bool one = mass.tree->kind == TreeKind::number && mass.tree->number == 1;
        text += (one ? "" : TextWriter().write(mass.tree, Hold::product) + " ") + dotted(entry.label);
    }
    return text;
}

void print_block(std::string& text, const EquationBlock& block)
{
    const bool fits = columns_of(block.title) + 3 + columns_of(block.formula) <= page_width;
    text += "\n" + block.title + (fits ? ":  " : ":\n  ") + block.formula + "\n";
    std::size_t widest = 0;
    for (const Equation& equation : block.equations) widest = std::max(widest, columns_of(left_side(equation)));
    widest = std::min(widest, page_width / 2);
    for (const Equation& equation : block.equations) {
        const std::string left = left_side(equation);
        const std::size_t columns = columns_of(left);
        text += "  " + std::string(columns < widest ? widest - columns : 0, ' ') + left + " = ";
        std::vector<std::pair<bool, std::string>> terms;
        for (const SignedTree& term : right_side_terms(equation))
            terms.emplace_back(term.negative, TextWriter().write(term.tree, Hold::quotient));
        if (terms.empty()) terms.emplace_back(false, "0");
        const std::size_t margin = widest + 5;
        const std::vector<std::string> lines =
            wrap_terms(terms, std::max(columns, widest) + 5, margin, page_width, columns_of);
        for (std::size_t k = 0; k < lines.size(); ++k)
            text += (k == 0 ? "" : std::string(margin, ' ')) + lines[k] + "\n";
    }
}

} // namespace

std::string print_text(const EquationSet& equations)
{
    std::string text = (equations.title.empty() ? equations.model : equations.title) + "\n";
    for (const EquationBlock& block : equations.blocks)
        if (!block.equations.empty()) print_block(text, block);
    return text;
}

} // namespace lagen
