// SPDX-License-Identifier: GPL-2.0-or-later
/// sin^2 + cos^2 = 1 in sums of which both terms are there: rows of kinetic energies in angles are full of them.
#include "graph/simplify/polynomial.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace lagen {
namespace {

/// monomial / atom^2.
Monomial without_square(const Monomial& monomial, AtomId atom)
{
    Monomial result;
    for (Factor factor : monomial) {
        if (factor.atom == atom) factor.exponent -= 2;
        if (factor.exponent != 0) result.push_back(factor);
    }
    return result;
}

/// A square of a sine or cosine in a term, as the argument and what is left of the monomial.
struct Square {
    AtomId atom;
    Monomial rest;
};

std::vector<Square> squares(const Algebra& algebra, const Monomial& monomial, Op op)
{
    std::vector<Square> result;
    for (const Factor& factor : monomial)
        if (algebra[factor.atom].op == op && factor.exponent >= 2)
            result.push_back({factor.atom, without_square(monomial, factor.atom)});
    return result;
}

bool same_argument(const Algebra& algebra, AtomId a, AtomId b)
{
    const Polynomial& x = algebra[a].operands[0];
    const Polynomial& y = algebra[b].operands[0];
    return !less(x, y) && !less(y, x);
}

struct Contraction {
    std::size_t sine;
    std::size_t cosine;
    Monomial rest;
};

std::optional<Contraction> find_contraction(const Algebra& algebra, const Polynomial& a)
{
    std::multimap<Monomial, std::pair<std::size_t, AtomId>> cosines;
    for (std::size_t k = 0; k < a.size(); ++k)
        for (const Square& square : squares(algebra, a[k].monomial, Op::cos))
            cosines.emplace(square.rest, std::pair{k, square.atom});
    if (cosines.empty()) return std::nullopt;
    for (std::size_t k = 0; k < a.size(); ++k)
        for (const Square& square : squares(algebra, a[k].monomial, Op::sin))
            for (auto [it, end] = cosines.equal_range(square.rest); it != end; ++it)
                if (it->second.first != k && a[it->second.first].coefficient == a[k].coefficient &&
                    same_argument(algebra, square.atom, it->second.second))
                    return Contraction{k, it->second.first, square.rest};
    return std::nullopt;
}

} // namespace

Polynomial Algebra::contract_circles(Polynomial a)
{
    while (const auto found = find_contraction(*this, a)) {
        Polynomial rest;
        for (std::size_t k = 0; k < a.size(); ++k)
            if (k != found->sine && k != found->cosine) rest.push_back(a[k]);
        a = add(rest, {{a[found->sine].coefficient, found->rest}});
    }
    return a;
}

} // namespace lagen
