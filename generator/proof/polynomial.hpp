// SPDX-License-Identifier: GPL-2.0-or-later
/// Sparse polynomials with integer coefficients in numbered generators, under a budget.
/// Terms are kept in descending lexicographic order (generator 0 is the greatest), so that equal polynomials are equal
/// arrays and every text made from them is the same on every machine.
#pragma once

#include <boost/container/small_vector.hpp>
#include <gmpxx.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace lagen::proof {

using GeneratorId = std::uint16_t;

/// Raised where an exact computation would outgrow its budget; what() names the bound.
struct BudgetExhausted : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A power product: (generator << 16 | exponent) in ascending order of generators; exponents are 1 .. 65535.
class Monomial {
  public:
    Monomial() = default;
    Monomial(GeneratorId generator, unsigned exponent);
    /// The product of the generators, which ascend, with their exponents, 0 among them.
    Monomial(const std::vector<GeneratorId>& generators, const std::vector<unsigned long>& exponents);

    [[nodiscard]] bool is_one() const { return factors_.empty(); }
    [[nodiscard]] std::size_t size() const { return factors_.size(); }
    [[nodiscard]] GeneratorId generator(std::size_t k) const { return static_cast<GeneratorId>(factors_[k] >> 16); }
    [[nodiscard]] unsigned exponent(std::size_t k) const { return factors_[k] & 0xffffU; }
    [[nodiscard]] unsigned exponent_of(GeneratorId generator) const;

    /// Throws BudgetExhausted where an exponent would leave 16 bits.
    friend Monomial operator*(const Monomial& a, const Monomial& b);
    /// a / b into `quotient`; false where b does not divide a.
    [[nodiscard]] static bool divide(const Monomial& a, const Monomial& b, Monomial& quotient);
    [[nodiscard]] static Monomial common(const Monomial& a, const Monomial& b);
    /// The monomial without this generator.
    [[nodiscard]] Monomial without(GeneratorId generator) const;

    friend bool operator==(const Monomial& a, const Monomial& b) { return a.factors_ == b.factors_; }
    /// Descending lexicographic order: true where a comes first.
    friend bool before(const Monomial& a, const Monomial& b);

  private:
    void append(GeneratorId generator, unsigned exponent);
    boost::container::small_vector<std::uint32_t, 8> factors_;
};

struct Before {
    bool operator()(const Monomial& a, const Monomial& b) const { return before(a, b); }
};

struct Term {
    Monomial monomial;
    mpz_class coefficient; ///< never 0
};

/// Longest coefficient in bits; a longer one costs more than any decision is worth.
inline constexpr std::size_t longest_coefficient = 100'000;

using Polynomial = std::vector<Term>; ///< sorted by `before`; empty: 0

/// What one decision may spend.
struct Work {
    std::size_t terms = 0;        ///< greatest number of terms of one polynomial
    std::size_t products = 0;     ///< term products left
    bool divisors_apart = false;  ///< each inverse is a generator of its own: no common denominators, fewer proofs
    bool radicands_first = false; ///< roots of products are taken apart by other radicands, whichever comes first
    void spend(std::size_t count);
};

[[nodiscard]] Polynomial constant_polynomial(const mpz_class& value);
[[nodiscard]] Polynomial generator_polynomial(GeneratorId generator, unsigned exponent = 1);
[[nodiscard]] bool is_constant(const Polynomial& p);
[[nodiscard]] bool is_one(const Polynomial& p);
[[nodiscard]] bool equal(const Polynomial& a, const Polynomial& b);

[[nodiscard]] Polynomial negate(Polynomial p);
[[nodiscard]] Polynomial scale(Polynomial p, const mpz_class& factor);
/// p + factor * q
[[nodiscard]] Polynomial add_scaled(const Polynomial& p, const Polynomial& q, const mpz_class& factor, Work& work);
[[nodiscard]] Polynomial multiply(const Polynomial& p, const Polynomial& q, Work& work);
[[nodiscard]] Polynomial multiply_term(const Polynomial& p, const Monomial& m, const mpz_class& factor, Work& work);
/// Sums terms in any order into a sorted polynomial.
[[nodiscard]] Polynomial collect(std::vector<Term> terms, Work& work);

/// Greatest common divisor of the coefficients, positive; 0 for the zero polynomial.
[[nodiscard]] mpz_class content(const Polynomial& p);
[[nodiscard]] Polynomial divide_content(Polynomial p, const mpz_class& divisor);
[[nodiscard]] Monomial monomial_content(const Polynomial& p);
[[nodiscard]] Polynomial divide_monomial(Polynomial p, const Monomial& divisor);

/// p / q where q divides p exactly in Z[generators]; false otherwise, or where that takes more than a few sweeps.
[[nodiscard]] bool divide_exactly(const Polynomial& p, const Polynomial& q, Polynomial& quotient, Work& work);
/// A polynomial with square p and positive leading coefficient; false where there is none.
[[nodiscard]] bool square_root(const Polynomial& p, Polynomial& root, Work& work);

/// A text that determines the polynomial, for keys.
[[nodiscard]] std::string key_of(const Polynomial& p);
[[nodiscard]] std::string key_of(const Monomial& m);

} // namespace lagen::proof
