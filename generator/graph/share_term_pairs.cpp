// SPDX-License-Identifier: GPL-2.0-or-later
/// Names for sums of two terms that several sums contain, up to a rational factor.
#include "graph/form.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace lagen {
namespace {

/// Pairs are not sought in longer sums: their number is quadratic.
constexpr std::size_t longest_sum = 40;
constexpr int largest_rounds = 1000;

/// Two monomials and the ratio of their coefficients.
struct Pair {
    Monomial first;
    Monomial second;
    Rational ratio;

    friend bool operator<(const Pair& a, const Pair& b)
    {
        if (a.first != b.first) return a.first < b.first;
        if (a.second != b.second) return a.second < b.second;
        return a.ratio < b.ratio;
    }
};

struct PolynomialLess {
    bool operator()(const Polynomial& a, const Polynomial& b) const { return less(a, b); }
};

/// Distinct sums of two or more terms and where they stand.
using Uses = std::map<Polynomial, std::vector<Place>, PolynomialLess>;

Uses sums_of(const Form& form)
{
    Uses uses;
    for (const Place& place : live_places(form))
        if (const Polynomial& sum = at(form, place); sum.size() > 1 && sum.size() <= longest_sum)
            uses[sum].push_back(place);
    return uses;
}

bool best_pair(const Uses& uses, Pair& best, std::vector<Polynomial>& holders)
{
    std::map<Pair, std::vector<const Polynomial*>> counts;
    for (const auto& [sum, places] : uses)
        for (std::size_t i = 0; i < sum.size(); ++i)
            for (std::size_t j = i + 1; j < sum.size(); ++j)
                counts[{sum[i].monomial, sum[j].monomial, sum[j].coefficient / sum[i].coefficient}].push_back(&sum);
    const std::vector<const Polynomial*>* most = nullptr;
    for (const auto& [pair, found] : counts)
        if (found.size() > 1 && (most == nullptr || found.size() > most->size())) {
            most = &found;
            best = pair;
        }
    if (most == nullptr) return false;
    holders.clear();
    for (const Polynomial* sum : *most) holders.push_back(*sum);
    return true;
}

/// The sum without the pair.
Polynomial without(const Polynomial& sum, const Pair& pair, Rational& first)
{
    Polynomial rest;
    for (const Term& term : sum) {
        if (term.monomial == pair.first) first = term.coefficient;
        if (term.monomial != pair.first && term.monomial != pair.second) rest.push_back(term);
    }
    return rest;
}

void rewrite(Form& form, Uses& uses, const Polynomial& old, const Pair& pair, const Term& name)
{
    Rational first;
    const Polynomial rest = without(old, pair, first);
    const Polynomial next = form.algebra.add(rest, {{name.coefficient * first, name.monomial}});
    auto node = uses.extract(old);
    for (const Place& place : node.mapped()) {
        const bool own = !place.root && name.monomial.size() == 1 && place.atom == name.monomial[0].atom;
        if (!own) at(form, place) = next;
        if (own)
            uses[old].push_back(place);
        else if (next.size() > 1)
            uses[next].push_back(place);
    }
}

} // namespace

void share_term_pairs(Form& form)
{
    Uses uses = sums_of(form);
    Pair pair;
    std::vector<Polynomial> holders;
    for (int round = 0; round < largest_rounds && best_pair(uses, pair, holders); ++round) {
        const std::size_t known = form.algebra.size();
        const Term name = form.algebra.as_term({{1, pair.first}, {pair.ratio, pair.second}});
        for (std::size_t id = known; id < form.algebra.size(); ++id)
            uses[form.algebra[static_cast<AtomId>(id)].operands[0]].push_back({false, static_cast<AtomId>(id), 0});
        bool changed = false;
        for (const Polynomial& holder : holders) {
            const bool own = uses.contains(holder) && uses[holder].size() == 1 && !uses[holder][0].root &&
                             name.monomial.size() == 1 && uses[holder][0].atom == name.monomial[0].atom;
            if (own || !uses.contains(holder)) continue;
            rewrite(form, uses, holder, pair, name);
            changed = true;
        }
        if (!changed) break;
    }
}

} // namespace lagen
