// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact quotients and square roots of polynomials, from the leading term down.
#include "proof/polynomial.hpp"

#include <map>

namespace lagen::proof {

namespace {

using Remainder = std::map<Monomial, mpz_class, Before>;

Remainder remainder_of(const Polynomial& p)
{
    Remainder remainder;
    for (const Term& term : p) remainder.emplace_hint(remainder.end(), term.monomial, term.coefficient);
    return remainder;
}

/// remainder -= factor * m * q
void subtract_multiple(Remainder& remainder, const Polynomial& q, const Monomial& m, const mpz_class& factor,
                       Work& work)
{
    work.spend(q.size());
    for (const Term& term : q) {
        const auto at = remainder.try_emplace(term.monomial * m).first;
        at->second -= factor * term.coefficient;
        if (at->second == 0) remainder.erase(at);
    }
}

bool divide_term(const Monomial& a, const mpz_class& ca, const Monomial& b, const mpz_class& cb, Term& quotient)
{
    if (!mpz_divisible_p(ca.get_mpz_t(), cb.get_mpz_t())) return false;
    if (!Monomial::divide(a, b, quotient.monomial)) return false;
    mpz_divexact(quotient.coefficient.get_mpz_t(), ca.get_mpz_t(), cb.get_mpz_t());
    return true;
}

} // namespace

bool divide_exactly(const Polynomial& p, const Polynomial& q, Polynomial& quotient, Work& work)
{
    quotient.clear();
    if (q.empty()) return false;
    if (p.empty()) return true;
    work.spend(1 + p[0].monomial.size());
    Term term;
    // The trailing terms must divide too: this refuses most hopeless cases at no cost.
    if (!divide_term(p.back().monomial, p.back().coefficient, q.back().monomial, q.back().coefficient, term))
        return false;
    if (!divide_term(p[0].monomial, p[0].coefficient, q[0].monomial, q[0].coefficient, term)) return false;
    Remainder remainder = remainder_of(p);
    const std::size_t most = 4 * p.size() + 64;
    while (!remainder.empty()) {
        const auto& [monomial, coefficient] = *remainder.begin();
        if (quotient.size() > most || !divide_term(monomial, coefficient, q[0].monomial, q[0].coefficient, term))
            return false;
        quotient.push_back(term);
        subtract_multiple(remainder, q, term.monomial, term.coefficient, work);
    }
    return true;
}

bool square_root(const Polynomial& p, Polynomial& root, Work& work)
{
    root.clear();
    if (p.empty()) return true;
    Term lead{p[0].monomial, p[0].coefficient};
    if (lead.coefficient < 0 || !mpz_perfect_square_p(lead.coefficient.get_mpz_t())) return false;
    lead.coefficient = sqrt(lead.coefficient);
    Monomial half;
    for (std::size_t k = 0; k < p[0].monomial.size(); ++k) {
        if (p[0].monomial.exponent(k) % 2 != 0) return false;
        half = half * Monomial(p[0].monomial.generator(k), p[0].monomial.exponent(k) / 2);
    }
    lead.monomial = half;
    root.push_back(lead);
    Remainder remainder = remainder_of(p);
    remainder.erase(remainder.begin());
    const mpz_class twice = 2 * lead.coefficient;
    Term term;
    while (!remainder.empty()) {
        const auto& [monomial, coefficient] = *remainder.begin();
        if (root.size() > p.size() || !divide_term(monomial, coefficient, lead.monomial, twice, term)) return false;
        if (!before(root.back().monomial, term.monomial)) return false;
        // (r + t)^2 = r^2 + 2 r t + t^2
        subtract_multiple(remainder, root, term.monomial, 2 * term.coefficient, work);
        subtract_multiple(remainder, {term}, term.monomial, term.coefficient, work);
        root.push_back(term);
    }
    return true;
}

} // namespace lagen::proof
