// SPDX-License-Identifier: GPL-2.0-or-later
/// Sums and multiples of sparse integer polynomials; every product is paid for out of `Work`.
#include "proof/polynomial.hpp"

#include <algorithm>

namespace lagen::proof {

namespace {

std::size_t limbs(const mpz_class& z)
{
    return mpz_size(z.get_mpz_t());
}

void check(const mpz_class& z)
{
    if (limbs(z) * 64 > longest_coefficient)
        throw BudgetExhausted("a coefficient exceeds " + std::to_string(longest_coefficient) + " bits");
}

void check(const Polynomial& p, const Work& work)
{
    if (p.size() > work.terms) throw BudgetExhausted("term budget of " + std::to_string(work.terms) + " exhausted");
}

} // namespace

void Work::spend(std::size_t count)
{
    if (count > products) {
        products = 0;
        throw BudgetExhausted("budget of term products exhausted");
    }
    products -= count;
}

Polynomial constant_polynomial(const mpz_class& value)
{
    check(value);
    if (value == 0) return {};
    return {Term{Monomial(), value}};
}

Polynomial generator_polynomial(GeneratorId generator, unsigned exponent)
{
    return {Term{Monomial(generator, exponent), 1}};
}

bool is_constant(const Polynomial& p)
{
    return p.empty() || (p.size() == 1 && p[0].monomial.is_one());
}

bool is_one(const Polynomial& p)
{
    return p.size() == 1 && p[0].monomial.is_one() && p[0].coefficient == 1;
}

bool equal(const Polynomial& a, const Polynomial& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Term& s, const Term& t) {
        return s.monomial == t.monomial && s.coefficient == t.coefficient;
    });
}

Polynomial negate(Polynomial p)
{
    for (Term& term : p) mpz_neg(term.coefficient.get_mpz_t(), term.coefficient.get_mpz_t());
    return p;
}

Polynomial scale(Polynomial p, const mpz_class& factor)
{
    if (factor == 0) return {};
    if (factor == 1) return p;
    for (Term& term : p) {
        term.coefficient *= factor;
        check(term.coefficient);
    }
    return p;
}

Polynomial add_scaled(const Polynomial& p, const Polynomial& q, const mpz_class& factor, Work& work)
{
    work.spend(p.size() + q.size());
    Polynomial sum;
    sum.reserve(p.size() + q.size());
    std::size_t i = 0, j = 0;
    while (i < p.size() || j < q.size()) {
        if (j == q.size() || (i < p.size() && before(p[i].monomial, q[j].monomial))) {
            sum.push_back(p[i++]);
        } else if (i == p.size() || before(q[j].monomial, p[i].monomial)) {
            sum.push_back({q[j].monomial, q[j].coefficient * factor});
            ++j;
        } else {
            mpz_class coefficient = p[i].coefficient + q[j].coefficient * factor;
            if (coefficient != 0) sum.push_back({p[i].monomial, std::move(coefficient)});
            ++i, ++j;
        }
    }
    check(sum, work);
    return sum;
}

Polynomial multiply_term(const Polynomial& p, const Monomial& m, const mpz_class& factor, Work& work)
{
    work.spend(p.size() * (1 + limbs(factor) / 4));
    Polynomial product;
    product.reserve(p.size());
    for (const Term& term : p) {
        product.push_back({term.monomial * m, term.coefficient * factor});
        check(product.back().coefficient);
    }
    return product;
}

Polynomial collect(std::vector<Term> terms, Work& work)
{
    work.spend(terms.size());
    std::stable_sort(terms.begin(), terms.end(),
                     [](const Term& a, const Term& b) { return before(a.monomial, b.monomial); });
    Polynomial result;
    result.reserve(terms.size());
    for (Term& term : terms) {
        if (!result.empty() && result.back().monomial == term.monomial) {
            result.back().coefficient += term.coefficient;
        } else {
            if (!result.empty() && result.back().coefficient == 0) result.pop_back();
            result.push_back(std::move(term));
        }
    }
    if (!result.empty() && result.back().coefficient == 0) result.pop_back();
    check(result, work);
    return result;
}

mpz_class content(const Polynomial& p)
{
    mpz_class divisor = 0;
    for (const Term& term : p) {
        mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), term.coefficient.get_mpz_t());
        if (divisor == 1) break;
    }
    return divisor;
}

Polynomial divide_content(Polynomial p, const mpz_class& divisor)
{
    if (divisor == 1) return p;
    for (Term& term : p) mpz_divexact(term.coefficient.get_mpz_t(), term.coefficient.get_mpz_t(), divisor.get_mpz_t());
    return p;
}

Monomial monomial_content(const Polynomial& p)
{
    if (p.empty()) return {};
    Monomial common = p[0].monomial;
    for (std::size_t k = 1; k < p.size() && !common.is_one(); ++k) common = Monomial::common(common, p[k].monomial);
    return common;
}

Polynomial divide_monomial(Polynomial p, const Monomial& divisor)
{
    if (divisor.is_one()) return p;
    for (Term& term : p) {
        Monomial quotient;
        if (!Monomial::divide(term.monomial, divisor, quotient)) continue;
        term.monomial = quotient;
    }
    return p;
}

std::string key_of(const Monomial& m)
{
    std::string key;
    for (std::size_t k = 0; k < m.size(); ++k)
        key += 'g' + std::to_string(m.generator(k)) + '^' + std::to_string(m.exponent(k));
    return key;
}

std::string key_of(const Polynomial& p)
{
    std::string key;
    for (const Term& term : p) {
        if (term.coefficient > 0) key += '+';
        key += term.coefficient.get_str() + key_of(term.monomial);
    }
    return key;
}

} // namespace lagen::proof
