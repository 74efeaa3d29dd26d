// SPDX-License-Identifier: GPL-2.0-or-later
/// x (a + b) - x a  ->  x b: a closed sum is multiplied out where its terms cancel others. Differences of nearly equal
/// products are computed nowhere that can be left out, and the closed sum may lose its last use.
#include "graph/form.hpp"

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

/// Opens the first closed sum that makes terms cancel and gains none; false where there is none.
bool cancel_once(Algebra& algebra, Polynomial& sum)
{
    for (std::size_t k = 0; k < sum.size(); ++k)
        for (const Factor& factor : sum[k].monomial) {
            const Atom& atom = algebra[factor.atom];
            if (atom.op != Op::add || factor.exponent != 1 || atom.operands[0].size() > largest_scanned_sum) continue;
            const std::size_t unmet = sum.size() - 1 + atom.operands[0].size();
            Polynomial next = opened(algebra, sum, k, factor.atom);
            if (next.size() > sum.size() || next.size() + 2 > unmet) continue;
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
