// SPDX-License-Identifier: GPL-2.0-or-later
/// Products of polynomials, short and long, against sums of multiples by one term.
#include "proof/polynomial.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace lagen::proof;

namespace {

constexpr Work plenty{1'000'000, 1'000'000'000};

/// 0 .. below - 1
unsigned roll(std::mt19937& random, unsigned below)
{
    return static_cast<unsigned>(random() % below);
}

Polynomial random_polynomial(std::mt19937& random, std::size_t terms, unsigned highest)
{
    std::vector<Term> list;
    for (std::size_t k = 0; k < terms; ++k) {
        Monomial monomial;
        for (unsigned id = 0; id < 8; ++id)
            if (roll(random, 2) == 0)
                monomial = monomial * Monomial(static_cast<GeneratorId>(3 * id), roll(random, highest));
        mpz_class coefficient = static_cast<long>(roll(random, 2001)) - 1000;
        if (roll(random, 4) == 0) coefficient <<= roll(random, 200);
        if (coefficient != 0) list.push_back({monomial, coefficient});
    }
    Work work = plenty;
    return collect(std::move(list), work);
}

Polynomial by_rows(const Polynomial& p, const Polynomial& q)
{
    Work work = plenty;
    Polynomial sum;
    for (const Term& term : p) sum = add_scaled(sum, multiply_term(q, term.monomial, term.coefficient, work), 1, work);
    return sum;
}

/// What ends the product; empty where nothing does.
std::string end_of(const Polynomial& p, const Polynomial& q, Work work)
{
    try {
        (void)multiply(p, q, work);
    } catch (const BudgetExhausted& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("a product is the sum of the rows, term by term and in order")
{
    std::mt19937 random(7);
    for (std::size_t k = 0; k < 200; ++k) {
        const Polynomial p = random_polynomial(random, 1 + roll(random, 60), 1 + roll(random, 9));
        const Polynomial q = random_polynomial(random, 1 + roll(random, 60), 1 + roll(random, 9));
        Work work = plenty;
        CHECK(equal(multiply(p, q, work), by_rows(p, q)));
        CHECK(equal(multiply(q, p, work), by_rows(p, q)));
    }
    Work work = plenty;
    const Polynomial long_one = random_polynomial(random, 3000, 4), other = random_polynomial(random, 200, 3);
    CHECK(equal(multiply(long_one, other, work), by_rows(other, long_one)));
}

TEST_CASE("cancelled terms are no terms of a product")
{
    Work work = plenty;
    std::vector<Term> above, below;
    for (unsigned k = 0; k < 100; ++k) {
        above.push_back({Monomial(0, k), 1});
        below.push_back({Monomial(0, k), k % 2 == 0 ? 1 : -1});
    }
    // (x^100 - 1)/(x - 1) * (1 - x^100)/(1 + x) = -(x^100 - 1)^2/(x^2 - 1), even in x and of degree 198
    const Polynomial product = multiply(collect(above, work), collect(below, work), work);
    CHECK(product.size() == 100);
    for (const Term& term : product) CHECK((term.monomial.is_one() || term.monomial.exponent(0) % 2 == 0));
}

TEST_CASE("a product beyond a bound ends by the bound's name")
{
    std::mt19937 random(11);
    const Polynomial p = random_polynomial(random, 100, 5), q = random_polynomial(random, 100, 5);
    CHECK(end_of(p, q, plenty).empty());
    CHECK(end_of(p, q, {1000, 1'000'000}) == "term budget of 1000 exhausted");
    CHECK(end_of(p, q, {100'000, 1000}) == "budget of term products exhausted");
    Work work = plenty;
    const Polynomial high = multiply_term(p, Monomial(0, 40'000), 1, work);
    CHECK(end_of(high, high, plenty) == "an exponent exceeds 65535");
    const Polynomial wide = scale(p, mpz_class(1) << 60'000);
    CHECK(end_of(wide, wide, plenty) == "a coefficient exceeds 100000 bits");
    const Polynomial heavy = scale(random_polynomial(random, 200, 9), mpz_class(1) << 49'000);
    CHECK(end_of(heavy, heavy, plenty) == "the coefficients of a product exceed 128 MiB");
}
