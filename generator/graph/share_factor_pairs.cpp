// SPDX-License-Identifier: GPL-2.0-or-later
/// Names for products of two factors that several terms contain, and for reciprocals that several terms need.
#include "graph/form.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

namespace lagen {
namespace {

/// Pairs are not sought in longer products.
constexpr std::size_t longest_product = 40;
constexpr int largest_rounds = 2000;

/// A distinct monomial and where it stands: equal monomials are one node of the graph already.
using Uses = std::map<Monomial, std::vector<Place>>;

Uses monomials_of(const Form& form)
{
    Uses uses;
    for (const Place& place : live_places(form))
        for (const Term& term : at(form, place))
            if (!term.monomial.empty()) uses[term.monomial].push_back(place);
    return uses;
}

/// Two factors by atom and side of the fraction bar.
struct Pair {
    AtomId first = 0;
    AtomId second = 0;
    bool first_below = false;
    bool second_below = false;
    friend auto operator<=>(const Pair&, const Pair&) = default;
    [[nodiscard]] bool both_below() const { return first_below && second_below; }
};

std::vector<Pair> pairs_of(const Monomial& monomial)
{
    std::vector<Pair> pairs;
    if (monomial.size() > longest_product) return pairs;
    for (std::size_t i = 0; i < monomial.size(); ++i)
        for (std::size_t j = i + 1; j < monomial.size(); ++j)
            pairs.push_back({monomial[i].atom, monomial[j].atom, monomial[i].exponent < 0, monomial[j].exponent < 0});
    return pairs;
}

/// The pair in most distinct monomials, at least two; ties go to pairs of divisors, then to the earlier one.
bool best_pair(const Uses& uses, Pair& best, std::vector<Monomial>& holders)
{
    std::map<Pair, std::vector<const Monomial*>> counts;
    for (const auto& [monomial, places] : uses)
        for (const Pair& pair : pairs_of(monomial)) counts[pair].push_back(&monomial);
    const std::vector<const Monomial*>* most = nullptr;
    for (const auto& [pair, found] : counts) {
        if (found.size() < 2) continue;
        if (most == nullptr || found.size() > most->size() ||
            (found.size() == most->size() && pair.both_below() && !best.both_below())) {
            most = &found;
            best = pair;
        }
    }
    if (most == nullptr) return false;
    holders.clear();
    for (const Monomial* monomial : *most) holders.push_back(*monomial);
    return true;
}

int held_exponent(const Monomial& monomial, AtomId atom)
{
    return std::ranges::lower_bound(monomial, atom, {}, &Factor::atom)->exponent;
}

/// The smallest exponents of the pair in all its holders: k / w^3 is shared whole, not as k / w.
Monomial common_part(const Pair& pair, const std::vector<Monomial>& holders)
{
    const auto smallest = [&](AtomId atom, bool below) {
        int magnitude = INT32_MAX;
        for (const Monomial& holder : holders) magnitude = std::min(magnitude, std::abs(held_exponent(holder, atom)));
        return Factor{atom, below ? -magnitude : magnitude};
    };
    return {smallest(pair.first, pair.first_below), smallest(pair.second, pair.second_below)};
}

/// monomial / part * replacement.
Monomial replaced(const Monomial& monomial, const Monomial& part, Factor replacement)
{
    Monomial result;
    for (Factor factor : monomial) {
        for (const Factor& taken : part)
            if (taken.atom == factor.atom) factor.exponent -= taken.exponent;
        if (factor.exponent != 0) result.push_back(factor);
    }
    const auto place = std::ranges::lower_bound(result, replacement.atom, {}, &Factor::atom);
    if (place != result.end() && place->atom == replacement.atom)
        place->exponent += replacement.exponent;
    else
        result.insert(place, replacement);
    return result;
}

/// Writes `next` for `old` wherever it stands, but for the definition of the atom `own`.
void rewrite(Form& form, Uses& uses, const Monomial& old, const Monomial& next, AtomId own)
{
    auto node = uses.extract(old);
    if (node.empty()) return;
    for (const Place& place : node.mapped()) {
        if (!place.root && place.atom == own) {
            uses[old].push_back(place);
            continue;
        }
        Polynomial& polynomial = at(form, place);
        for (Term& term : polynomial)
            if (term.monomial == old) term.monomial = next;
        std::ranges::sort(polynomial, [](const Term& a, const Term& b) { return a.monomial < b.monomial; });
        uses[next].push_back(place);
    }
}

/// An atom for a product; its definition joins the monomials in use.
AtomId name_product(Form& form, Uses& uses, const Monomial& product)
{
    const std::size_t known = form.algebra.size();
    const AtomId id = form.algebra.atom(Op::multiply, 0, {Polynomial{{1, product}}});
    if (id == known) uses[product].push_back({false, id, 0});
    return id;
}

} // namespace

void share_factor_pairs(Form& form)
{
    Uses uses = monomials_of(form);
    Pair pair;
    std::vector<Monomial> holders;
    for (int round = 0; round < largest_rounds && best_pair(uses, pair, holders); ++round) {
        const Monomial part = common_part(pair, holders);
        const AtomId name = name_product(form, uses, part);
        for (const Monomial& holder : holders) rewrite(form, uses, holder, replaced(holder, part, {name, 1}), name);
    }
}

void share_reciprocals(Form& form)
{
    Uses uses = monomials_of(form);
    std::set<AtomId> divisors;
    for (const auto& [monomial, places] : uses)
        for (const Factor& factor : monomial)
            if (factor.exponent < 0) divisors.insert(factor.atom);
    for (const AtomId atom : divisors) {
        std::vector<Monomial> holders;
        for (const auto& [monomial, places] : uses)
            for (const Factor& factor : monomial)
                if (factor.atom == atom && factor.exponent < 0) holders.push_back(monomial);
        if (holders.size() < 2) continue;
        const AtomId name = name_product(form, uses, {{atom, -1}});
        for (const Monomial& holder : holders) {
            const int exponent = held_exponent(holder, atom);
            rewrite(form, uses, holder, replaced(holder, {{atom, exponent}}, {name, -exponent}), name);
        }
    }
}

} // namespace lagen
