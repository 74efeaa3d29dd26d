// SPDX-License-Identifier: GPL-2.0-or-later
/// Tree to text with the fewest parentheses. The walk keeps its own stack, and stops at a length: a shared tree of 40
/// doublings has 2^40 characters.
#include "expression/tree.hpp"

#include <algorithm>
#include <cstdint>

namespace lagen {

namespace {

constexpr std::size_t longest_text = 1'000'000;

/// How tightly a text holds together, loosest first, as in the grammar.
enum class Tightness { comparison, sum, product, sign, power, atom };

/// An exact finite decimal of p/q, or "" where q has prime factors other than 2 and 5.
std::string finite_decimal(const Rational& value)
{
    mpz_class rest = value.get_den();
    const mpz_class two = 2, five = 5;
    const std::size_t twos = mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), two.get_mpz_t());
    const std::size_t fives = mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), five.get_mpz_t());
    if (rest != 1) return "";
    const std::size_t decimals = std::max(twos, fives);
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, decimals);
    const mpz_class scaled = abs(value.get_num()) * (scale / value.get_den());
    std::string digits = scaled.get_str();
    if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
    digits.insert(digits.size() - decimals, ".");
    return value < 0 ? "-" + digits : digits;
}

struct NumberText {
    std::string text;
    Tightness tightness;
};

NumberText number_text(const Rational& value)
{
    const Tightness whole = value < 0 ? Tightness::sign : Tightness::atom;
    if (value.get_den() == 1) return {value.get_str(), whole};
    const std::string fraction = value.get_str();
    const std::string decimal = finite_decimal(value);
    if (!decimal.empty() && decimal.size() < fraction.size()) return {decimal, whole};
    return {fraction, Tightness::product};
}

Tightness tightness_of(const TreeNode& node)
{
    switch (node.kind) {
    case TreeKind::number: return number_text(node.number).tightness;
    case TreeKind::compare: return Tightness::comparison;
    case TreeKind::add: return node.arguments.empty() ? Tightness::atom : Tightness::sum;
    case TreeKind::multiply: return node.arguments.empty() ? Tightness::atom : Tightness::product;
    case TreeKind::divide: return Tightness::product;
    case TreeKind::negate: return Tightness::sign;
    case TreeKind::power: return Tightness::power;
    default: return Tightness::atom;
    }
}

/// What is still to be printed: a sub-tree that must hold together at least as tightly as `least`, or (null) a text.
struct Pending {
    const TreeNode* node;
    Tightness least;
    const char* text;
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
    void print_node(const TreeNode& node, Tightness least)
    {
        const bool enclosed = tightness_of(node) < least;
        std::vector<Pending> parts;
        if (enclosed) parts.push_back({nullptr, least, "("});
        add_parts(node, parts);
        if (enclosed) parts.push_back({nullptr, least, ")"});
        // A leaf has written itself into `leaf_`, which must appear now, between the parentheses.
        for (auto part = parts.rbegin(); part != parts.rend(); ++part) pending_.push_back(*part);
    }

    void add_parts(const TreeNode& node, std::vector<Pending>& parts);
    void add_list(const TreeNode& node, std::vector<Pending>& parts, Tightness least, const char* separator);
    void append(std::string_view text);

    std::string text_;
    std::vector<Pending> pending_;
    std::vector<std::string> leaves_;
};

} // namespace

} // namespace lagen
