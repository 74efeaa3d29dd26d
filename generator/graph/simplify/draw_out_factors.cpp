// SPDX-License-Identifier: GPL-2.0-or-later
/// a x + b x + c  ->  (a + b) x + c, by the factor that saves most, until no two terms of a sum share one.
#include "graph/simplify/form.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// What terms can share: an atom in the numerator or in the denominator, or the size of a rational coefficient.
struct SharedFactor {
    enum class Kind : std::uint8_t { divisor, factor, coefficient } kind = Kind::factor;
    AtomId atom = 0;
    Rational magnitude;

    friend bool operator<(const SharedFactor& a, const SharedFactor& b)
    {
        if (a.kind != b.kind) return a.kind < b.kind;
        return a.atom != b.atom ? a.atom < b.atom : a.magnitude < b.magnitude;
    }
};

std::vector<SharedFactor> candidates(const Term& term)
{
    using Kind = SharedFactor::Kind;
    std::vector<SharedFactor> result;
    for (const Factor& factor : term.monomial)
        result.push_back({factor.exponent > 0 ? Kind::factor : Kind::divisor, factor.atom, 0});
    const Rational magnitude = abs(term.coefficient);
    if (magnitude != 1 && !term.monomial.empty()) result.push_back({Kind::coefficient, 0, magnitude});
    return result;
}

/// The candidate of most terms, at least two; ties go to divisors, then to the earlier atom. False where there is none.
bool best_candidate(const Polynomial& sum, SharedFactor& best)
{
    std::map<SharedFactor, std::size_t> counts;
    for (const Term& term : sum)
        for (const SharedFactor& candidate : candidates(term)) ++counts[candidate];
    std::size_t most = 1;
    for (const auto& [candidate, count] : counts)
        if (count > most) {
            most = count;
            best = candidate;
        }
    return most > 1;
}

bool has(const Term& term, const SharedFactor& wanted)
{
    const auto all = candidates(term);
    return std::ranges::any_of(all, [&](const SharedFactor& c) { return !(c < wanted) && !(wanted < c); });
}

Polynomial horner(Algebra& algebra, Polynomial sum)
{
    SharedFactor best;
    while (sum.size() > 1 && best_candidate(sum, best)) {
        Polynomial inside;
        Polynomial outside;
        for (Term& term : sum) (has(term, best) ? inside : outside).push_back(std::move(term));
        sum = algebra.add(outside, {algebra.as_term(inside)});
    }
    return sum;
}

} // namespace

void draw_out_factors(Form& form)
{
    const std::size_t known = form.algebra.size();
    for (const Place& place : live_places(form)) {
        Polynomial drawn = horner(form.algebra, at(form, place));
        at(form, place) = std::move(drawn);
    }
    // Sums that were just closed are new atoms; they may contain further common factors.
    for (std::size_t id = known; id < form.algebra.size(); ++id) {
        const auto atom = static_cast<AtomId>(id);
        Polynomial drawn = horner(form.algebra, form.algebra[atom].operands[0]);
        form.algebra.operands(atom)[0] = std::move(drawn);
    }
}

} // namespace lagen
