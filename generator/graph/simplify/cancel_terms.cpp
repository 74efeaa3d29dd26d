// SPDX-License-Identifier: GPL-2.0-or-later
/// x (a + b) - x a  ->  x b: a closed sum is multiplied out where its terms cancel others; where that would make the
/// sum around it longer, it loses the terms that cancel and stays closed. Differences of nearly equal products are
/// computed nowhere that can be left out, and the closed sum may lose its last use.
#include "graph/simplify/form.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// Neither longer sums nor longer factors are looked at: the pass is cubic.
constexpr std::size_t largest_scanned_sum = 40;

/// `sum` with its k-th term multiplied out by the closed sum `atom`.
Polynomial opened(Algebra& algebra, const Polynomial& sum, std::size_t k, AtomId atom)
{
    Term rest = sum[k];
    std::erase_if(rest.monomial, [atom](const Factor& factor) { return factor.atom == atom; });
    Polynomial others = sum;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    return algebra.add(others, algebra.distribute({rest}, algebra[atom].operands[0]));
}

/// The same with the closed sum of what does not cancel; `sum` itself where all of it stays.
Polynomial reduced(Algebra& algebra, const Polynomial& sum, std::size_t k, AtomId atom)
{
    Term rest = sum[k];
    std::erase_if(rest.monomial, [atom](const Factor& factor) { return factor.atom == atom; });
    Polynomial others = sum;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const Polynomial inside = algebra[atom].operands[0];
    Polynomial kept;
    for (const Term& term : inside) {
        const Term product = algebra.multiply(rest, term);
        const auto same = std::ranges::lower_bound(others, product.monomial, {}, &Term::monomial);
        if (same != others.end() && same->monomial == product.monomial && same->coefficient == -product.coefficient)
            others.erase(same);
        else
            kept.push_back(term);
    }
    if (kept.empty()) return others;
    return kept.size() == inside.size() ? sum : algebra.add(others, {algebra.multiply(rest, algebra.as_term(kept))});
}

/// Opens the first closed sum that makes terms cancel and gains none; false where there is none.
bool cancel_once(Algebra& algebra, Polynomial& sum)
{
    for (std::size_t k = 0; k < sum.size(); ++k)
        for (const Factor& factor : sum[k].monomial) {
            const Atom& atom = algebra[factor.atom];
            if (atom.op != Op::add || factor.exponent != 1 || atom.operands[0].size() > largest_scanned_sum) continue;
            const std::size_t unmet = sum.size() - 1 + atom.operands[0].size();
            Polynomial next = opened(algebra, sum, k, factor.atom);
            if (next.size() + 2 > unmet) continue;
            if (next.size() > sum.size()) {
                next = reduced(algebra, sum, k, factor.atom);
                if (next.size() >= sum.size()) continue;
            }
            sum = std::move(next);
            return true;
        }
    return false;
}

} // namespace

void cancel_terms(Form& form)
{
    for (const Place& place : live_places(form)) {
        Polynomial sum = at(form, place);
        if (sum.size() < 2 || sum.size() > largest_scanned_sum) continue;
        for (std::size_t round = 0; round < largest_scanned_sum && cancel_once(form.algebra, sum); ++round) {
        }
        at(form, place) = std::move(sum);
    }
}

} // namespace lagen
