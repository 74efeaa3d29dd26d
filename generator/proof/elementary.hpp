// SPDX-License-Identifier: GPL-2.0-or-later
/// Elementary functions of fractions as ring elements. Arguments of sin, cos and exp are split into rational multiples
/// of "atoms" (power products over a denominator); each atom has one unit, and the addition theorems do the rest. Roots
/// are generators w with w^q = radicand; |p| is a generator with square p^2; log splits off what is certainly positive.
/// Every rule holds wherever its argument is defined and the domain holds; what no rule covers becomes a free generator
/// keyed by its arguments, which can only miss zeros.
#pragma once

#include "proof/ring.hpp"

namespace lagen::proof {

/// How cos(a + b) is seen: by the addition theorem, or as a generator of the whole angle (better for signs).
enum class Angles { split, whole };

class Elementary {
  public:
    explicit Elementary(Ring& ring, Angles angles = Angles::split) : ring_(ring), angles_(angles) {}

    [[nodiscard]] Fraction pi();
    struct SineCosine {
        Fraction sine, cosine;
    };
    [[nodiscard]] SineCosine sine_cosine(const Fraction& angle);
    [[nodiscard]] Fraction exponential(const Fraction& argument);
    [[nodiscard]] Fraction logarithm(const Fraction& argument);
    /// argument^(1/degree) >= 0
    [[nodiscard]] Fraction root(const Fraction& argument, unsigned degree);
    [[nodiscard]] Fraction absolute(const Fraction& argument);
    [[nodiscard]] Fraction real_power(const Fraction& base, const Fraction& exponent);
    [[nodiscard]] Fraction opaque(const std::string& name, const std::vector<Fraction>& arguments);

    /// True once a unit became finer, so that results made before no longer meet those made now; resets.
    [[nodiscard]] bool take_refined() { return std::exchange(refined_, false); }

  private:
    /// coefficient * atom; the atom has coefficient 1.
    struct Part {
        mpq_class coefficient;
        Fraction atom;
    };
    struct Unit {
        mpq_class size;
        GeneratorId first = 0;  ///< sin(size * atom), or exp(size * atom)
        GeneratorId second = 0; ///< cos(size * atom)
    };
    struct Factor {
        Polynomial base;
        int exponent = 0;
    };
    struct Factored {
        mpq_class number;
        std::vector<Factor> factors;
    };

    [[nodiscard]] std::vector<Part> parts(const Fraction& argument) const;
    [[nodiscard]] Factored factored(const Fraction& a);
    /// The multiple k with coefficient = k * unit; refines the unit where it does not divide.
    [[nodiscard]] mpz_class multiple_of_unit(std::map<std::string, Unit>& units, const Part& part, bool angle);
    void make_generators(Unit& unit, const Fraction& atom, bool angle);
    [[nodiscard]] SineCosine multiple_angle(const Unit& unit, const mpz_class& multiple);
    [[nodiscard]] SineCosine pi_angle(const mpq_class& turns);
    [[nodiscard]] SineCosine sum(const SineCosine& a, const SineCosine& b);
    [[nodiscard]] Fraction number_root(const mpq_class& number, unsigned degree);
    [[nodiscard]] Fraction root_generator(const Polynomial& radicand, unsigned degree);
    [[nodiscard]] Fraction remaining_root(const Polynomial& radicand, unsigned degree);
    [[nodiscard]] std::optional<Fraction> denested(const Polynomial& radicand);
    [[nodiscard]] Fraction absolute_generator(const Polynomial& p);
    [[nodiscard]] Fraction number_logarithm(const mpq_class& number);
    [[nodiscard]] Fraction factor_logarithm(const Polynomial& p);
    [[nodiscard]] Fraction log_generator(const Polynomial& p);
    [[nodiscard]] const Fraction* exponent_of(const Polynomial& p) const; ///< of a single exp generator, else nullptr

    Ring& ring_;
    Angles angles_;
    bool refined_ = false;
    std::map<std::string, Unit> angle_units_;
    std::map<std::string, Unit> exponential_units_;
    std::map<GeneratorId, Fraction> exponents_; ///< of exp generators
    std::map<GeneratorId, Polynomial> logs_;    ///< arguments of log generators
};

/// The primes of |number| up to a bound, with multiplicities, and what is left (1, or a number without small primes).
[[nodiscard]] std::vector<std::pair<mpz_class, unsigned>> small_factors(const mpz_class& number);

} // namespace lagen::proof
