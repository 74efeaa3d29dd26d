// SPDX-License-Identifier: GPL-2.0-or-later
/// Tree to text with the fewest parentheses. The walk keeps its own stack, and stops at a length: a shared tree of 40
/// doublings has 2^40 characters.
#include "expression/closed.hpp"
#include "expression/parse.hpp"
#include "expression/tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace lagen {

namespace {

constexpr std::size_t longest_text = 1'000'000;

/// How tightly a text holds together, loosest first, as in the grammar.
enum class Tightness { comparison, sum, product, sign, power, atom };

/// Digits beyond this are shortened to 21e399 or 5e-30 where the zeros allow it.
constexpr std::size_t widest_number = 24;

/// The digits and the power of ten of |p/q| as a finite decimal.
struct Decimal {
    std::string digits; ///< of |p/q| * 10^decimals, an integer
    std::size_t decimals;
};

std::optional<Decimal> finite_decimal(const Rational& value)
{
    mpz_class rest = value.get_den();
    const mpz_class two = 2, five = 5;
    const std::size_t twos = mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), two.get_mpz_t());
    const std::size_t fives = mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), five.get_mpz_t());
    if (rest != 1) return std::nullopt;
    const std::size_t decimals = std::max(twos, fives);
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, decimals);
    const mpz_class scaled = abs(value.get_num()) * (scale / value.get_den());
    return Decimal{scaled.get_str(), decimals};
}

/// The digits with a point before the last `decimals` of them.
std::string with_point(std::string digits, std::size_t decimals)
{
    if (decimals == 0) return digits;
    if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
    const std::size_t point = digits.size() - decimals;
    return fmt::format("{}.{}", digits.substr(0, point), digits.substr(point));
}

/// The text without its sign. No exponent goes beyond what the parser accepts: 140e400, not 14e401.
std::string decimal_text(const Decimal& decimal)
{
    static constexpr auto largest = static_cast<std::size_t>(ParseLimits{}.decimal_exponent);
    const std::string& digits = decimal.digits;
    if (std::max(digits.size(), decimal.decimals + 2) <= widest_number) return with_point(digits, decimal.decimals);
    if (decimal.decimals > 0) {
        const std::size_t shift = std::min(decimal.decimals, largest);
        return fmt::format("{}e-{}", with_point(digits, decimal.decimals - shift), shift);
    }
    const std::size_t zeros = std::min(digits.size() - digits.find_last_not_of('0') - 1, largest);
    return zeros > 3 ? fmt::format("{}e{}", digits.substr(0, digits.size() - zeros), zeros) : digits;
}

struct NumberText {
    std::string text;
    Tightness tightness;
};

NumberText number_text(const Rational& value)
{
    const std::string sign = value < 0 ? "-" : "";
    const Tightness whole = value < 0 ? Tightness::sign : Tightness::atom;
    const std::optional<Decimal> decimal = finite_decimal(value);
    const std::string text = decimal ? sign + decimal_text(*decimal) : std::string();
    if (value.get_den() == 1) return {text, whole};
    std::string fraction = value.get_str();
    if (decimal && text.size() < fraction.size()) return {text, whole};
    return {std::move(fraction), Tightness::product};
}

/// A sum or product of one entry is that entry.
const TreeNode& unwrapped(const TreeNode& node)
{
    const TreeNode* inner = &node;
    while ((inner->kind == TreeKind::add || inner->kind == TreeKind::multiply) && inner->arguments.size() == 1)
        inner = inner->arguments[0].get();
    return *inner;
}

/// Products and quotients, and numbers written as one, with signs or without: --1/2 is read as (--1)/2.
bool reads_as_product(const TreeNode& outer)
{
    const TreeNode* node = &unwrapped(outer);
    while (node->kind == TreeKind::negate) node = &unwrapped(*node->arguments[0]);
    if (node->kind == TreeKind::number) return number_text(node->number).tightness == Tightness::product;
    return node->kind == TreeKind::divide || (node->kind == TreeKind::multiply && !node->arguments.empty());
}

Tightness tightness_of(const TreeNode& node)
{
    switch (node.kind) {
    case TreeKind::number: return number_text(node.number).tightness;
    case TreeKind::compare: return Tightness::comparison;
    case TreeKind::add: return node.arguments.empty() ? Tightness::atom : Tightness::sum;
    case TreeKind::multiply: return node.arguments.empty() ? Tightness::atom : Tightness::product;
    case TreeKind::divide: return Tightness::product;
    // -a*b stands for -(a*b): the same value, but x/-a*b is not x/(-(a*b)).
    case TreeKind::negate: return reads_as_product(*node.arguments[0]) ? Tightness::product : Tightness::sign;
    case TreeKind::power: return Tightness::power;
    default: return Tightness::atom;
    }
}

const char* spaced(Comparison comparison)
{
    switch (comparison) {
    case Comparison::less: return " < ";
    case Comparison::less_equal: return " <= ";
    case Comparison::greater: return " > ";
    case Comparison::greater_equal: return " >= ";
    case Comparison::equal: return " == ";
    case Comparison::not_equal: return " != ";
    }
    return " ? ";
}

/// One piece that is still to be printed: a sub-tree that must hold together at least as tightly as `least`, or (null)
/// a text.
struct Pending {
    const TreeNode* node;
    Tightness least;
    std::string text;
};

class Printer {
  public:
    std::string print(const TreeNode& root)
    {
        pending_.push_back({&root, Tightness::comparison, ""});
        while (!pending_.empty() && text_.size() <= longest_text) {
            const Pending next = pending_.back();
            pending_.pop_back();
            if (next.node)
                print_node(*next.node, next.least);
            else
                append(next.text);
        }
        if (text_.size() > longest_text) {
            text_.resize(longest_text);
            text_ += "...";
        }
        return std::move(text_);
    }

  private:
    void print_node(const TreeNode& outer, Tightness least);
    void open(const TreeNode& node);
    void open_index(const TreeNode& node);
    void open_solve(const TreeNode& node);

    /// Leaves `node`'s arguments from `first` on to be printed, separated.
    void list(const TreeNode& node, const char* separator, Tightness least, std::size_t first = 0)
    {
        for (std::size_t k = node.arguments.size(); k-- > first;) {
            pending_.push_back({node.arguments[k].get(), least, ""});
            if (k > first) pending_.push_back({nullptr, least, separator});
        }
    }

    /// Leaves `text` to be printed.
    void later(std::string text) { pending_.push_back({nullptr, Tightness::atom, std::move(text)}); }

    void pair(const TreeNode& node, const char* separator, Tightness left, Tightness right)
    {
        pending_.push_back({node.arguments[1].get(), right, ""});
        pending_.push_back({nullptr, right, separator});
        pending_.push_back({node.arguments[0].get(), left, ""});
    }

    void append(std::string_view text)
    {
        const bool negative_term = text.starts_with('-') && text_.ends_with(" + ");
        if (negative_term) { // a + -b reads a - b
            text_.replace(text_.size() - 2, 2, "- ");
            text.remove_prefix(1);
        }
        text_ += text;
    }

    std::string text_;
    std::vector<Pending> pending_;
};

void Printer::print_node(const TreeNode& outer, Tightness least)
{
    const TreeNode& node = unwrapped(outer);
    const bool enclosed = tightness_of(node) < least;
    if (enclosed) {
        append("(");
        pending_.push_back({nullptr, least, ")"});
    }
    open(node);
}

/// Prints what comes before the first argument, and leaves the rest to be printed.
void Printer::open(const TreeNode& node)
{
    switch (node.kind) {
    case TreeKind::number: append(number_text(node.number).text); break;
    case TreeKind::pi: append("pi"); break;
    case TreeKind::name: append(node.name); break;
    case TreeKind::negate:
        append("-");
        pending_.push_back(
            {node.arguments[0].get(), reads_as_product(*node.arguments[0]) ? Tightness::product : Tightness::sign, ""});
        break;
    case TreeKind::add: node.arguments.empty() ? append("0") : list(node, " + ", Tightness::sum); break;
    case TreeKind::multiply: node.arguments.empty() ? append("1") : list(node, "*", Tightness::product); break;
    case TreeKind::divide: pair(node, "/", Tightness::product, Tightness::sign); break;
    case TreeKind::power: pair(node, "^", Tightness::atom, Tightness::sign); break;
    case TreeKind::compare: pair(node, spaced(node.comparison), Tightness::sum, Tightness::sum); break;
    case TreeKind::call:
    case TreeKind::apply:
        if (is_range(node)) {
            node.arguments.empty() ? append(":") : list(node, "..", Tightness::sum);
            break;
        }
        append(node.kind == TreeKind::call ? entry_of(node.function).name : node.name);
        append("(");
        pending_.push_back({nullptr, Tightness::atom, ")"});
        list(node, ", ", Tightness::comparison);
        break;
    case TreeKind::sum_over:
    case TreeKind::product_over:
        append(node.kind == TreeKind::sum_over ? "sum(" : "product(");
        append(node.name);
        append(", ");
        later(")");
        list(node, ", ", Tightness::comparison);
        break;
    case TreeKind::array:
        append("[");
        later("]");
        list(node, ", ", Tightness::comparison);
        break;
    case TreeKind::index: open_index(node); break;
    case TreeKind::solve: open_solve(node); break;
    }
}

/// base[i] or base[i,j]; what could not carry an index as it stands is enclosed.
void Printer::open_index(const TreeNode& node)
{
    const TreeNode& base = unwrapped(*node.arguments[0]);
    const bool entry = base.kind == TreeKind::name && base.name.ends_with(']');
    const bool enclosed =
        tightness_of(base) == Tightness::atom &&
        (entry || base.kind == TreeKind::index || base.kind == TreeKind::number || base.kind == TreeKind::solve ||
         base.kind == TreeKind::add || base.kind == TreeKind::multiply);
    later("]");
    list(node, ",", Tightness::comparison, 1);
    later(enclosed ? ")[" : "[");
    if (enclosed) append("(");
    pending_.push_back({&base, Tightness::atom, ""});
}

/// (inverse([[a, b], [c, d]])*[e, f])[k], k from 1.
void Printer::open_solve(const TreeNode& node)
{
    const std::size_t m = solve_order(node.arguments.size());
    const mpz_class k = node.number.get_num() + 1;
    later(fmt::format("])[{}]", k.get_str()));
    list(node, ", ", Tightness::comparison, m * m);
    later("]])*[");
    for (std::size_t row = m; row-- > 0;) {
        for (std::size_t column = m; column-- > 0;) {
            pending_.push_back({node.arguments[row * m + column].get(), Tightness::comparison, ""});
            if (column > 0) later(", ");
        }
        if (row > 0) later("], [");
    }
    append("(inverse([[");
}

} // namespace

std::string to_text(const Tree& tree)
{
    return Printer().print(*tree);
}

} // namespace lagen
