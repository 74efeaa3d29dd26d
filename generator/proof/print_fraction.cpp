// SPDX-License-Identifier: GPL-2.0-or-later
/// Texts of polynomials and fractions.
#include "proof/print_fraction.hpp"

#include "text/alphabet.hpp"

#include <algorithm>
#include <string_view>

namespace lagen::proof {

namespace {

/// True where an operator of `text` stands outside of all parentheses.
bool is_open(const std::string& text)
{
    int depth = 0;
    for (const char c : text) {
        depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
        if (depth == 0 && std::string_view("+-*/^ ").find(c) != std::string_view::npos) return true;
    }
    return false;
}

/// `^` is right-associative and binds more tightly than anything else: the base of a power stands in parentheses.
std::string power_text(const std::string& base, unsigned exponent)
{
    if (exponent == 1) return base;
    return (is_open(base) ? '(' + base + ')' : base) + '^' + std::to_string(exponent);
}

/// Without its sign.
std::string term_text(const Ring& ring, const Term& term)
{
    std::string text;
    const mpz_class magnitude = abs(term.coefficient);
    if (magnitude != 1 || term.monomial.is_one()) text = magnitude.get_str();
    for (std::size_t k = 0; k < term.monomial.size(); ++k) {
        if (!text.empty()) text += '*';
        text += power_text(ring.generator(term.monomial.generator(k)).text, term.monomial.exponent(k));
    }
    return text;
}

std::string denominator_text(const Ring& ring, const Fraction& a, std::size_t limit)
{
    std::vector<std::string> parts;
    if (a.scale != 1) parts.push_back(a.scale.get_str());
    for (const auto& [index, power] : a.factors) {
        const Polynomial& factor = ring.factor(index);
        const std::string text = to_text(ring, factor, limit);
        parts.push_back(power_text(factor.size() > 1 ? '(' + text + ')' : text, power));
    }
    if (parts.empty()) return {};
    std::string product = parts[0];
    for (std::size_t k = 1; k < parts.size(); ++k) product += '*' + parts[k];
    const bool single = parts.size() == 1;
    return single ? product : '(' + product + ')';
}

Tree product_tree(std::vector<Tree> factors)
{
    return factors.size() == 1 ? std::move(factors[0]) : multiply(std::move(factors));
}

Tree power_tree(const Tree& base, unsigned exponent)
{
    return exponent == 1 ? base : power(base, number(exponent));
}

/// Null where a generator has no tree.
Tree term_tree(const Ring& ring, const Term& term)
{
    std::vector<Tree> factors;
    const mpz_class magnitude = abs(term.coefficient);
    if (magnitude != 1 || term.monomial.is_one()) factors.push_back(number(Rational(magnitude)));
    for (std::size_t k = 0; k < term.monomial.size(); ++k) {
        const Tree& base = ring.generator(term.monomial.generator(k)).tree;
        if (!base) return nullptr;
        factors.push_back(power_tree(base, term.monomial.exponent(k)));
    }
    const Tree product = product_tree(std::move(factors));
    return term.coefficient < 0 ? negate(product) : product;
}

Tree polynomial_tree(const Ring& ring, const Polynomial& p)
{
    if (p.empty()) return number(0);
    std::vector<Tree> terms;
    for (const Term& term : p) {
        terms.push_back(term_tree(ring, term));
        if (!terms.back()) return nullptr;
    }
    return terms.size() == 1 ? terms[0] : add(std::move(terms));
}

} // namespace

std::string to_text(const Ring& ring, const Polynomial& p, std::size_t limit)
{
    if (p.empty()) return "0";
    const std::string tail = p.size() == 1 ? "" : " ... (" + std::to_string(p.size()) + " terms)";
    std::string text;
    for (std::size_t k = 0; k < p.size(); ++k) {
        std::string piece = k == 0 ? "" : " + ";
        if (p[k].coefficient < 0) piece = k == 0 ? "-" : " - ";
        piece += term_text(ring, p[k]);
        const bool last = k + 1 == p.size();
        if (text.size() + piece.size() + (last ? 0 : tail.size()) > limit) {
            // A first term that is too long on its own is cut; of later ones only whole terms are shown.
            if (k == 0) text = whole_characters(piece, limit - std::min(limit, tail.size() + 3)) + "...";
            return text + tail;
        }
        text += piece;
    }
    return text;
}

std::string to_text(const Ring& ring, const Fraction& a, std::size_t limit)
{
    const std::string below = denominator_text(ring, a, limit / 4);
    if (below.empty()) return to_text(ring, a.num, limit);
    if (below.size() + 40 > limit) return '(' + to_text(ring, a.num, limit / 2) + ")/(...)";
    const std::string above = to_text(ring, a.num, limit - below.size() - 3);
    return (a.num.size() > 1 ? '(' + above + ')' : above) + '/' + below;
}

bool is_whole(const std::string& text)
{
    return text.find("...") == std::string::npos;
}

Tree to_tree(const Ring& ring, const Fraction& a)
{
    const Tree above = polynomial_tree(ring, a.num);
    std::vector<Tree> below;
    if (a.scale != 1) below.push_back(number(Rational(a.scale)));
    for (const auto& [index, power] : a.factors) {
        const Tree factor = polynomial_tree(ring, ring.factor(index));
        below.push_back(factor ? power_tree(factor, power) : nullptr);
    }
    if (!above || std::ranges::count(below, nullptr) > 0) return nullptr;
    return below.empty() ? above : divide(above, product_tree(std::move(below)));
}

Printed print(const Ring& ring, const Fraction& a, std::size_t limit)
{
    std::string text = to_text(ring, a, limit);
    Tree tree = is_whole(text) ? to_tree(ring, a) : nullptr;
    return {std::move(text), std::move(tree)};
}

Printed print(const Ring& ring, const Polynomial& p, std::size_t limit)
{
    std::string text = to_text(ring, p, limit);
    Tree tree = is_whole(text) ? polynomial_tree(ring, p) : nullptr;
    return {std::move(text), std::move(tree)};
}

Tree call_of(Function function, std::vector<Tree> arguments)
{
    if (std::ranges::count(arguments, nullptr) > 0) return nullptr;
    return call(function, std::move(arguments));
}

Tree call_of(const std::string& function, std::vector<Tree> arguments)
{
    const FunctionEntry* entry = find_function(function);
    const bool known = entry != nullptr && !entry->array && entry->arity == arguments.size();
    return known ? call_of(entry->function, std::move(arguments)) : nullptr;
}

} // namespace lagen::proof
