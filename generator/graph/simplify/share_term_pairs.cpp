// SPDX-License-Identifier: GPL-2.0-or-later
/// Names for sums of two terms that several sums contain, up to a rational factor.
#include "graph/simplify/form.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace lagen {
namespace {

/// Pairs are not sought in longer sums: their number is quadratic.
constexpr std::size_t longest_sum = 40;
constexpr int term_rounds = 1000;

/// Two monomials and the ratio of their coefficients.
struct TermPair {
    Monomial first;
    Monomial second;
    Rational ratio;

    friend bool operator<(const TermPair& a, const TermPair& b)
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
        if (!fresh) return;
        for_pairs(*key, [&](const Key& pair, std::size_t i, std::size_t j) {
            const auto [held, unseen] = holders_.try_emplace(pair);
            if (unseen)
                held->second.pair = {(*key)[i].monomial, (*key)[j].monomial,
                                     (*key)[j].coefficient / (*key)[i].coefficient};
            unrank(held->second);
            held->second.sums.push_back(key);
            rank(held->second);
        });
    }

    [[nodiscard]] const std::vector<Place>* places(const Polynomial& sum) const
    {
        const auto found = uses_.find(sum);
        return found == uses_.end() ? nullptr : &found->second;
    }

    std::vector<Place> take(const Polynomial& sum)
    {
        const auto found = uses_.find(sum);
        for_pairs(found->first, [&](const Key& pair, std::size_t, std::size_t) {
            const auto held = holders_.find(pair);
            unrank(held->second);
            std::erase(held->second.sums, &found->first);
            rank(held->second);
            if (held->second.sums.empty()) holders_.erase(held);
        });
        std::vector<Place> places = std::move(found->second);
        uses_.erase(found);
        return places;
    }

    /// The pair that most sums hold, two at least, and these sums in order; of several such pairs the first.
    [[nodiscard]] bool best_pair(TermPair& best, std::vector<Polynomial>& holders) const
    {
        if (ranks_.empty()) return false;
        const Held& most = *ranks_.begin()->held;
        best = most.pair;
        holders.clear();
        for (const Polynomial* sum : most.sums) holders.push_back(*sum);
        std::sort(holders.begin(), holders.end(), PolynomialLess{});
        return true;
    }

  private:
    /// A pair by the numbers of its monomials and of its ratio: comparing these takes no time.
    struct Key {
        std::uint32_t first = 0;
        std::uint32_t second = 0;
        std::uint32_t ratio = 0;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct KeyHash {
        std::size_t operator()(const Key& key) const
        {
            const std::uint64_t monomials = (std::uint64_t{key.first} << 32U) | key.second;
            const std::uint64_t mixed = (monomials ^ (std::uint64_t{key.ratio} << 48U)) * 0x9e3779b97f4a7c15ULL;
            return static_cast<std::size_t>(mixed ^ (mixed >> 29U));
        }
    };
    struct Held {
        TermPair pair;
        std::vector<const Polynomial*> sums; ///< keys of uses_
    };
    struct Rank {
        std::size_t holders = 0;
        const Held* held = nullptr;

        friend bool operator<(const Rank& a, const Rank& b)
        {
            return a.holders != b.holders ? a.holders > b.holders : a.held->pair < b.held->pair;
        }
    };

    void unrank(const Held& held)
    {
        if (held.sums.size() > 1) ranks_.erase({held.sums.size(), &held});
    }
    void rank(const Held& held)
    {
        if (held.sums.size() > 1) ranks_.insert({held.sums.size(), &held});
    }

    template <class Value, class Numbers>
    static std::uint32_t number_of(const Value& value, Numbers& numbers)
    {
        return numbers.try_emplace(value, static_cast<std::uint32_t>(numbers.size())).first->second;
    }

    template <class Action>
    void for_pairs(const Polynomial& sum, Action action)
    {
        std::vector<std::uint32_t> numbers;
        for (const Term& term : sum) numbers.push_back(number_of(term.monomial, monomials_));
        for (std::size_t i = 0; i < sum.size(); ++i)
            for (std::size_t j = i + 1; j < sum.size(); ++j) {
                const bool equal = sum[i].coefficient == sum[j].coefficient;
                const std::uint32_t ratio = equal
                                                ? number_of(one_, ratios_)
                                                : number_of(Rational(sum[j].coefficient / sum[i].coefficient), ratios_);
                action(Key{numbers[i], numbers[j], ratio}, i, j);
            }
    }

    const Rational one_ = 1;
    std::map<Polynomial, std::vector<Place>, PolynomialLess> uses_;
    std::map<Monomial, std::uint32_t> monomials_;
    std::map<Rational, std::uint32_t> ratios_;
    std::unordered_map<Key, Held, KeyHash> holders_; ///< looked up, never iterated
    std::set<Rank> ranks_;                           ///< of the pairs with two holders or more
};

/// The sum without the pair.
Polynomial without(const Polynomial& sum, const TermPair& pair, Rational& first)
{
    Polynomial rest;
    for (const Term& term : sum) {
        if (term.monomial == pair.first) first = term.coefficient;
        if (term.monomial != pair.first && term.monomial != pair.second) rest.push_back(term);
    }
    return rest;
}

void rewrite(Form& form, Sums& sums, const Polynomial& old, const TermPair& pair, const Term& name)
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
    TermPair pair;
    std::vector<Polynomial> holders;
    for (int round = 0; round < term_rounds && sums.best_pair(pair, holders); ++round) {
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
