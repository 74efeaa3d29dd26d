// SPDX-License-Identifier: GPL-2.0-or-later
/// Products and sums in sorted form.
#include "symbolic/sorted_form.hpp"

#include <algorithm>
#include <cstdio>

namespace lagen {
namespace {

/// "|" and an ascending code for descending exponents, then the exponent itself where the code rounds.
std::string exponent_key(const Rational& exponent)
{
    char code[40];
    std::snprintf(code, sizeof code, "^%012.4f", 500000.0 - exponent.get_d());
    return code + ("[" + exponent.get_str() + "]");
}

/// The key of a product: '~' sorts after every other character, so that x^2 y precedes x^2 and numbers stand last.
std::string product_key(const std::vector<SortedFactor>& factors)
{
    std::string key;
    for (const SortedFactor& factor : factors) key += factor.key + exponent_key(factor.exponent) + ";";
    return key + "~";
}

bool by_key(const SortedTerm& a, const SortedTerm& b)
{
    return a.key < b.key;
}

std::string sum_key(const std::vector<SortedTerm>& terms)
{
    std::string key = "(";
    for (const SortedTerm& term : terms) key += term.key + "*" + term.coefficient.get_str() + ",";
    return key + ")";
}

bool is_constant(const std::vector<SortedTerm>& terms)
{
    for (const SortedTerm& term : terms)
        for (const SortedFactor& factor : term.factors)
            if (!factor.constant) return false;
    return true;
}

/// The positive rational that leaves coprime integer coefficients, with the sign of the first term.
Rational content_of(const std::vector<SortedTerm>& terms)
{
    mpz_class numerator = 0;
    mpz_class denominator = 1;
    for (const SortedTerm& term : terms) {
        numerator = gcd(numerator, term.coefficient.get_num());
        denominator = lcm(denominator, term.coefficient.get_den());
    }
    Rational content(numerator, denominator);
    content.canonicalize();
    return terms.front().coefficient < 0 ? -content : content;
}

/// A sum as a factor; its terms are sorted and merged already.
SortedFactor sum_factor(std::vector<SortedTerm> terms)
{
    SortedFactor factor;
    factor.constant = is_constant(terms);
    factor.key = (factor.constant ? "2" : "5") + sum_key(terms);
    factor.terms = std::move(terms);
    return factor;
}

// ---- trees ----

Tree raised(const Tree& base, const Rational& exponent)
{
    if (exponent == 1) return base;
    if (exponent == Rational(1, 2)) return call(Function::sqrt, {base});
    return power(base, number(exponent));
}

Tree sum_tree(const std::vector<SortedTerm>& terms);

Tree base_tree(const SortedFactor& factor)
{
    return factor.terms.empty() ? factor.base : sum_tree(factor.terms);
}

Tree product_or_one(std::vector<Tree> factors)
{
    if (factors.empty()) return number(1);
    return factors.size() == 1 ? factors[0] : multiply(std::move(factors));
}

/// A term with positive coefficient as one fraction.
Tree fraction_tree(const Rational& coefficient, const std::vector<SortedFactor>& factors)
{
    std::vector<Tree> above;
    std::vector<Tree> below;
    if (coefficient.get_den() != 1) below.push_back(number(Rational(coefficient.get_den())));
    if (coefficient.get_num() != 1) above.push_back(number(Rational(coefficient.get_num())));
    for (const SortedFactor& factor : factors) {
        const bool inverse = factor.exponent < 0;
        const Rational exponent = abs(factor.exponent);
        (inverse ? below : above).push_back(raised(base_tree(factor), exponent));
    }
    Tree numerator = product_or_one(std::move(above));
    return below.empty() ? numerator : divide(std::move(numerator), product_or_one(std::move(below)));
}

/// The first factor above the bar that is a difference: -(a - b) c reads better as (b - a) c.
SortedFactor* reversible(std::vector<SortedFactor>& factors)
{
    for (SortedFactor& factor : factors)
        if (factor.exponent == 1 && std::any_of(factor.terms.begin(), factor.terms.end(),
                                                [](const SortedTerm& t) { return t.coefficient < 0; }))
            return &factor;
    return nullptr;
}

/// The sign of a term and its tree without the sign.
std::pair<bool, Tree> signed_tree(const SortedTerm& term)
{
    if (term.coefficient >= 0) return {false, fraction_tree(term.coefficient, term.factors)};
    std::vector<SortedFactor> factors = term.factors;
    SortedFactor* difference = reversible(factors);
    if (difference == nullptr) return {true, fraction_tree(-term.coefficient, factors)};
    for (SortedTerm& inner : difference->terms) inner.coefficient = -inner.coefficient;
    return {false, fraction_tree(-term.coefficient, factors)};
}

/// Terms in their order; where the first one is negative, positive ones come before the others.
Tree sum_tree(const std::vector<SortedTerm>& terms)
{
    std::vector<std::pair<bool, Tree>> parts;
    for (const SortedTerm& term : terms) parts.push_back(signed_tree(term));
    if (!parts.empty() && parts.front().first)
        std::stable_partition(parts.begin(), parts.end(), [](const auto& part) { return !part.first; });
    std::vector<Tree> trees;
    for (auto& [negative, tree] : parts) trees.push_back(negative ? negate(std::move(tree)) : std::move(tree));
    return add(std::move(trees));
}

} // namespace

SortedTerm product_of(std::vector<SortedFactor> factors, const Rational& coefficient)
{
    SortedTerm term{coefficient, std::move(factors), {}};
    return sorted_product({term});
}

SortedTerm divided(const SortedTerm& term, std::vector<SortedFactor> divisor)
{
    for (SortedFactor& factor : divisor) factor.exponent = -factor.exponent;
    return sorted_product({term, product_of(std::move(divisor), 1)});
}

std::vector<SortedTerm> terms_in(const SortedTerm& sum)
{
    if (sum.factors.size() != 1 || sum.factors[0].terms.empty() || sum.factors[0].exponent != 1) return {sum};
    std::vector<SortedTerm> terms = sum.factors[0].terms;
    for (SortedTerm& term : terms) term.coefficient *= sum.coefficient;
    return terms;
}

SortedTerm sorted_product(const std::vector<SortedTerm>& factors)
{
    SortedTerm result;
    result.coefficient = 1;
    std::map<std::string, SortedFactor> merged;
    for (const SortedTerm& term : factors) {
        result.coefficient *= term.coefficient;
        for (const SortedFactor& factor : term.factors) {
            const auto [slot, fresh] = merged.emplace(factor.key, factor);
            if (!fresh) slot->second.exponent += factor.exponent;
        }
    }
    if (result.coefficient != 0)
        for (auto& [key, factor] : merged)
            if (factor.exponent != 0) result.factors.push_back(std::move(factor));
    result.key = product_key(result.factors);
    return result;
}

SortedTerm sorted_sum(const std::vector<SortedTerm>& summands)
{
    std::map<std::string, SortedTerm> merged;
    for (const SortedTerm& summand : summands)
        for (const SortedTerm& term : terms_in(summand)) {
            const auto [slot, fresh] = merged.emplace(term.key, term);
            if (!fresh) slot->second.coefficient += term.coefficient;
        }
    std::vector<SortedTerm> terms;
    for (auto& [key, term] : merged)
        if (term.coefficient != 0) terms.push_back(std::move(term));
    if (terms.empty()) return {0, {}, product_key({})};
    if (terms.size() == 1) return terms[0];
    std::sort(terms.begin(), terms.end(), by_key);
    const Rational content = content_of(terms);
    for (SortedTerm& term : terms) term.coefficient /= content;
    SortedTerm result{content, {sum_factor(std::move(terms))}, {}};
    result.key = product_key(result.factors);
    return result;
}

Tree tree_of(const SortedTerm& term)
{
    const std::vector<SortedTerm> terms = terms_in(term);
    if (terms.size() > 1) return sum_tree(terms);
    auto [negative, tree] = signed_tree(term);
    return negative ? negate(std::move(tree)) : std::move(tree);
}

} // namespace lagen
