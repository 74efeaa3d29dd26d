// SPDX-License-Identifier: GPL-2.0-or-later
/// Names for products of two factors that several terms contain, and for reciprocals that several terms need.
#include "graph/simplify/form.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

namespace lagen {
namespace {

/// Pairs are not sought in longer products.
constexpr std::size_t longest_product = 40;
constexpr int factor_rounds = 2000;

/// Two factors by atom and side of the fraction bar.
struct FactorPair {
    AtomId first = 0;
    AtomId second = 0;
    bool first_below = false;
    bool second_below = false;
    friend auto operator<=>(const FactorPair&, const FactorPair&) = default;
    [[nodiscard]] bool both_below() const { return first_below && second_below; }
};

std::vector<FactorPair> pairs_of(const Monomial& monomial)
{
    std::vector<FactorPair> pairs;
    if (monomial.size() > longest_product) return pairs;
    for (std::size_t i = 0; i < monomial.size(); ++i)
        for (std::size_t j = i + 1; j < monomial.size(); ++j)
            pairs.push_back({monomial[i].atom, monomial[j].atom, monomial[i].exponent < 0, monomial[j].exponent < 0});
    return pairs;
}

/// The distinct monomials (equal ones are one node of the graph already) with their places, and for every pair of
/// factors the monomials that hold it.
class Monomials {
  public:
    enum class Index : std::uint8_t { none, pairs };

    Monomials(const Form& form, Index index) : indexed_(index == Index::pairs)
    {
        for (const Place& place : live_places(form))
            for (const Term& term : at(form, place))
                if (!term.monomial.empty()) add(term.monomial, place);
    }

    void add(const Monomial& monomial, const Place& place)
    {
        const auto [entry, fresh] = uses_.try_emplace(monomial);
        entry->second.push_back(place);
        if (fresh) count(entry->first, true);
    }

    /// Removes the monomial; answers its places.
    std::vector<Place> take(const Monomial& monomial)
    {
        const auto found = uses_.find(monomial);
        if (found == uses_.end()) return {};
        count(found->first, false);
        std::vector<Place> places = std::move(found->second);
        uses_.erase(found);
        return places;
    }

    /// The pair in most distinct monomials, at least two, and these in order; ties go to pairs of divisors, then to the
    /// earlier one.
    [[nodiscard]] bool best_pair(FactorPair& best, std::vector<Monomial>& holders) const
    {
        if (ranks_.empty()) return false;
        best = ranks_.begin()->pair;
        const std::set<Monomial>& found = holders_.at(best);
        holders.assign(found.begin(), found.end());
        return true;
    }

    [[nodiscard]] const std::map<Monomial, std::vector<Place>>& uses() const { return uses_; }

  private:
    struct Rank {
        std::size_t holders = 0;
        FactorPair pair;

        friend bool operator<(const Rank& a, const Rank& b)
        {
            if (a.holders != b.holders) return a.holders > b.holders;
            if (a.pair.both_below() != b.pair.both_below()) return a.pair.both_below();
            return a.pair < b.pair;
        }
    };

    /// Counts the monomial among the holders of its pairs, or no more.
    void count(const Monomial& monomial, bool present)
    {
        if (!indexed_) return;
        for (const FactorPair& pair : pairs_of(monomial)) {
            std::set<Monomial>& found = holders_[pair];
            if (found.size() > 1) ranks_.erase({found.size(), pair});
            if (present)
                found.insert(monomial);
            else
                found.erase(monomial);
            if (found.size() > 1) ranks_.insert({found.size(), pair});
        }
    }

    std::map<Monomial, std::vector<Place>> uses_;
    bool indexed_;
    std::map<FactorPair, std::set<Monomial>> holders_;
    std::set<Rank> ranks_; ///< of the pairs with two holders or more
};

int held_exponent(const Monomial& monomial, AtomId atom)
{
    return std::ranges::lower_bound(monomial, atom, {}, &Factor::atom)->exponent;
}

/// The smallest exponents of the pair in all its holders: k / w^3 is shared whole, not as k / w.
Monomial common_part(const FactorPair& pair, const std::vector<Monomial>& holders)
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
void rewrite(Form& form, Monomials& monomials, const Monomial& old, const Monomial& next, AtomId own)
{
    for (const Place& place : monomials.take(old)) {
        if (!place.root && place.atom == own) {
            monomials.add(old, place);
            continue;
        }
        Polynomial& polynomial = at(form, place);
        for (Term& term : polynomial)
            if (term.monomial == old) term.monomial = next;
        std::ranges::sort(polynomial, [](const Term& a, const Term& b) { return a.monomial < b.monomial; });
        monomials.add(next, place);
    }
}

/// An atom for a product; its definition joins the monomials in use.
AtomId name_product(Form& form, Monomials& monomials, const Monomial& product)
{
    const std::size_t known = form.algebra.size();
    const AtomId id = form.algebra.atom(Op::multiply, 0, {Polynomial{{1, product}}});
    if (id == known) monomials.add(product, {false, id, 0});
    return id;
}

} // namespace

void share_factor_pairs(Form& form)
{
    Monomials monomials(form, Monomials::Index::pairs);
    FactorPair pair;
    std::vector<Monomial> holders;
    for (int round = 0; round < factor_rounds && monomials.best_pair(pair, holders); ++round) {
        const Monomial part = common_part(pair, holders);
        const AtomId name = name_product(form, monomials, part);
        for (const Monomial& holder : holders)
            rewrite(form, monomials, holder, replaced(holder, part, {name, 1}), name);
    }
}

void share_reciprocals(Form& form)
{
    Monomials monomials(form, Monomials::Index::none);
    std::map<AtomId, std::set<Monomial>> holders_of; // by divisor
    for (const auto& [monomial, places] : monomials.uses())
        for (const Factor& factor : monomial)
            if (factor.exponent < 0) holders_of[factor.atom].insert(monomial);
    while (!holders_of.empty()) {
        const AtomId atom = holders_of.begin()->first;
        const std::set<Monomial> holders = std::move(holders_of.begin()->second);
        holders_of.erase(holders_of.begin());
        if (holders.size() < 2) continue;
        const AtomId name = name_product(form, monomials, {{atom, -1}});
        for (const Monomial& holder : holders) {
            const int exponent = held_exponent(holder, atom);
            const Monomial next = replaced(holder, {{atom, exponent}}, {name, -exponent});
            rewrite(form, monomials, holder, next, name);
            for (const Factor& factor : next) // the divisors that are still to come
                if (const auto other = holders_of.find(factor.atom); factor.exponent < 0 && other != holders_of.end()) {
                    other->second.erase(holder);
                    other->second.insert(next);
                }
        }
    }
}

} // namespace lagen
