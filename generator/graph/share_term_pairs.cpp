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

/// Distinct sums of two or more terms and where they stand, with the pairs that each of them holds.
class Sums {
  public:
    explicit Sums(const Form& form)
    {
        for (const Place& place : live_places(form))
            if (const Polynomial& sum = at(form, place); sum.size() > 1 && sum.size() <= longest_sum) add(sum, place);
    }

    void add(const Polynomial& sum, const Place& place)
    {
        const auto [entry, fresh] = uses_.try_emplace(sum);
        entry->second.push_back(place);
        const Polynomial* key = &entry->first;
        if (fresh) for_pairs(*key, [&](const Pair& pair) { holders_[pair].push_back(key); });
    }

    [[nodiscard]] const std::vector<Place>* places(const Polynomial& sum) const
    {
        const auto found = uses_.find(sum);
        return found == uses_.end() ? nullptr : &found->second;
    }

    std::vector<Place> take(const Polynomial& sum)
    {
        const auto found = uses_.find(sum);
        for_pairs(found->first, [&](const Pair& pair) {
            const auto holders = holders_.find(pair);
            if (std::erase(holders->second, &found->first) > 0 && holders->second.empty()) holders_.erase(holders);
        });
        std::vector<Place> places = std::move(found->second);
        uses_.erase(found);
        return places;
    }

    /// The pair that most sums hold, two at least, and these sums in order; of several such pairs the first.
    [[nodiscard]] bool best_pair(Pair& best, std::vector<Polynomial>& holders) const
    {
        const std::vector<const Polynomial*>* most = nullptr;
        for (const auto& [pair, found] : holders_)
            if (found.size() > 1 && (most == nullptr || found.size() > most->size())) {
                most = &found;
                best = pair;
            }
        if (most == nullptr) return false;
        holders.clear();
        for (const Polynomial* sum : *most) holders.push_back(*sum);
        std::sort(holders.begin(), holders.end(), PolynomialLess{});
        return true;
    }

  private:
    template <class Action>
    static void for_pairs(const Polynomial& sum, Action action)
    {
        for (std::size_t i = 0; i < sum.size(); ++i)
            for (std::size_t j = i + 1; j < sum.size(); ++j)
                action(Pair{sum[i].monomial, sum[j].monomial, sum[j].coefficient / sum[i].coefficient});
    }

    std::map<Polynomial, std::vector<Place>, PolynomialLess> uses_;
    std::map<Pair, std::vector<const Polynomial*>> holders_; ///< keys of uses_
};

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

void rewrite(Form& form, Sums& sums, const Polynomial& old, const Pair& pair, const Term& name)
{
    Rational first;
    const Polynomial rest = without(old, pair, first);
    const Polynomial next = form.algebra.add(rest, {{name.coefficient * first, name.monomial}});
    for (const Place& place : sums.take(old)) {
        const bool own = !place.root && name.monomial.size() == 1 && place.atom == name.monomial[0].atom;
        if (!own) at(form, place) = next;
        if (own)
            sums.add(old, place);
        else if (next.size() > 1)
            sums.add(next, place);
    }
}

} // namespace

void share_term_pairs(Form& form)
{
    Sums sums(form);
    Pair pair;
    std::vector<Polynomial> holders;
    for (int round = 0; round < largest_rounds && sums.best_pair(pair, holders); ++round) {
        const std::size_t known = form.algebra.size();
        const Term name = form.algebra.as_term({{1, pair.first}, {pair.ratio, pair.second}});
        for (std::size_t id = known; id < form.algebra.size(); ++id)
            sums.add(form.algebra[static_cast<AtomId>(id)].operands[0], {false, static_cast<AtomId>(id), 0});
        bool changed = false;
        for (const Polynomial& holder : holders) {
            const std::vector<Place>* places = sums.places(holder);
            const bool own = places != nullptr && places->size() == 1 && !(*places)[0].root &&
                             name.monomial.size() == 1 && (*places)[0].atom == name.monomial[0].atom;
            if (own || places == nullptr) continue;
            rewrite(form, sums, holder, pair, name);
            changed = true;
        }
        if (!changed) break;
    }
}

} // namespace lagen
