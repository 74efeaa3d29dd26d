// SPDX-License-Identifier: GPL-2.0-or-later
#include "symbolic/joined_angles.hpp"

namespace lagen {
namespace {

constexpr std::size_t most_terms = 400; ///< of a sum in which pairs of angles are sought

bool is_sine_or_cosine(const SortedFactor& factor)
{
    return factor.terms.empty() && factor.base->kind == TreeKind::call && factor.exponent > 0 &&
           (factor.base->function == Function::sin || factor.base->function == Function::cos);
}

/// cos for sin and sin for cos of the same argument, to this power.
SortedFactor complement(const SortedFactor& factor, int exponent)
{
    const Function other = factor.base->function == Function::sin ? Function::cos : Function::sin;
    SortedFactor result = factor;
    result.base = call(other, factor.base->arguments);
    result.exponent = exponent;
    result.key.replace(2, function_key(other).size(), function_key(other));
    return result;
}

void add_term(std::map<std::string, SortedTerm>& terms, const SortedTerm& term)
{
    const auto [slot, fresh] = terms.emplace(term.key, term);
    if (!fresh) slot->second.coefficient += term.coefficient;
    if (slot->second.coefficient == 0) terms.erase(slot);
}

/// One use of T sin^2 + T cos^2 = T or of T - T sin^2 = T cos^2 (and with cos); false where there is none.
bool join_squares(std::map<std::string, SortedTerm>& terms)
{
    for (const auto& [key, term] : terms)
        for (const SortedFactor& factor : term.factors) {
            if (!is_sine_or_cosine(factor) || factor.exponent < 2) continue;
            SortedFactor square = factor;
            square.exponent = 2;
            const SortedTerm rest = divided(term, {square});
            const SortedTerm partner = sorted_product({rest, product_of({complement(factor, 2)}, 1)});
            const auto beside = terms.find(partner.key);
            const auto whole = terms.find(rest.key);
            const bool sum = beside != terms.end() && beside->second.coefficient == term.coefficient;
            const bool difference = whole != terms.end() && whole->second.coefficient == -term.coefficient;
            if (!sum && !difference) continue;
            SortedTerm joined = sum ? rest : partner;
            joined.coefficient = sum ? Rational(term.coefficient) : Rational(-term.coefficient);
            const std::string used = key;
            terms.erase(sum ? beside : whole);
            terms.erase(used);
            add_term(terms, joined);
            return true;
        }
    return false;
}

std::map<std::string, SortedTerm> by_keys(const SortedTerm& sum)
{
    std::map<std::string, SortedTerm> terms;
    for (const SortedTerm& term : terms_in(sum)) terms.emplace(term.key, term);
    return terms;
}

SortedTerm sum_of(const std::map<std::string, SortedTerm>& terms)
{
    std::vector<SortedTerm> list;
    for (const auto& [key, term] : terms) list.push_back(term);
    return sorted_sum(list);
}

} // namespace

SortedTerm with_joined_squares(const SortedTerm& sum)
{
    std::map<std::string, SortedTerm> terms = by_keys(sum);
    while (join_squares(terms)) {
    }
    return sum_of(terms);
}

/// function(a +- b) of the arguments of two factors.
SortedTerm AngleSums::of_sum(Function function, const SortedFactor& a, const SortedFactor& b, bool plus) const
{
    SymbolTable symbols = symbols_;
    const GiNaC::ex first = to_ginac(a.base->arguments[0], symbols), second = to_ginac(b.base->arguments[0], symbols);
    const GiNaC::ex angle = plus ? first + second : first - second;
    return sort_expression(function == Function::sin ? GiNaC::sin(angle) : GiNaC::cos(angle), symbols_, order_);
}

/// One use with the term that has this key and another one; false where there is none.
bool AngleSums::join(Terms& terms, const std::string& key) const
{
    const SortedTerm term = terms.at(key);
    for (std::size_t i = 0; i < term.factors.size(); ++i)
        for (std::size_t j = i + 1; j < term.factors.size(); ++j) {
            SortedFactor a = term.factors[i], b = term.factors[j];
            if (!is_sine_or_cosine(a) || !is_sine_or_cosine(b)) continue;
            a.exponent = b.exponent = 1;
            const SortedTerm rest = divided(term, {a, b});
            const SortedTerm partner = sorted_product({rest, product_of({complement(a, 1), complement(b, 1)}, 1)});
            const auto other = terms.find(partner.key);
            if (other == terms.end() || partner.key == key || // sin a cos a is a pair with itself
                abs(other->second.coefficient) != abs(term.coefficient))
                continue;
            const bool same = other->second.coefficient == term.coefficient;
            Rational coefficient = term.coefficient;
            SortedTerm angle;
            if (a.base->function == b.base->function) {
                angle = of_sum(Function::cos, a, b, !same);
                if (a.base->function == Function::sin) coefficient = other->second.coefficient; // that of cos cos
            } else {
                const bool sine_first = a.base->function == Function::sin;
                angle = of_sum(Function::sin, sine_first ? a : b, sine_first ? b : a, same);
            }
            terms.erase(other);
            terms.erase(key);
            SortedTerm joined = sorted_product({rest, angle});
            joined.coefficient *= coefficient / rest.coefficient;
            add_term(terms, joined);
            return true;
        }
    return false;
}

SortedTerm AngleSums::joined(const SortedTerm& sum) const
{
    Terms terms = by_keys(sum);
    if (terms.size() > most_terms) return sum;
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::string> keys;
        for (const auto& [key, term] : terms) keys.push_back(key);
        for (const std::string& key : keys)
            if (terms.contains(key) && join(terms, key)) changed = true;
    }
    return sum_of(terms);
}

} // namespace lagen
