// SPDX-License-Identifier: GPL-2.0-or-later
/// The ring in which one decision works: Q[inputs, sin u, cos u, exp u, roots, ...] modulo one relation for some
/// generators, g^k = polynomial in others, with coprime leading terms (so that reduction decides membership of the
/// ideal of the relations). Fractions keep their denominators as a multiset of factors: no greatest common divisors,
/// only exact trial division.
#pragma once

#include "proof/enclosure.hpp"
#include "proof/polynomial.hpp"
#include "proof/range.hpp"

#include <map>
#include <optional>
#include <utility>

namespace lagen::proof {

/// Raised where a divisor is identically zero; what() is the text of the division.
struct VanishingDivisor : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// num / (scale * product of factors^power); scale > 0, factors ascending by index, powers positive.
struct Fraction {
    Polynomial num;
    mpz_class scale = 1;
    std::vector<std::pair<std::size_t, unsigned>> factors;

    [[nodiscard]] bool is_zero() const { return num.empty(); }
    [[nodiscard]] bool is_polynomial() const { return factors.empty(); }
    /// The value where the fraction is a rational constant.
    [[nodiscard]] std::optional<mpq_class> constant() const;
};

struct Generator {
    std::string text;   ///< in the expression language; with "..." where it has no name there (is_whole)
    Range range;        ///< of its values on the domain
    unsigned power = 0; ///< generator^power = relation; 0: free
    Polynomial relation;
    int partner = -1; ///< of a cosine: its sine (and of a sine: its cosine)
    bool is_sine = false;
    std::optional<Ball> value = std::nullopt; ///< of a constant such as sqrt(2) or pi
    Tree tree = nullptr;                      ///< null where it has no name in the language, or one too long to be read
    bool is_absolute = false;                 ///< |p|: a root of degree 2 of a square, whose logarithm is no half
};

/// What is known of a polynomial on the domain.
struct SignFact {
    Polynomial polynomial;
    Signs signs;
};

class Ring {
  public:
    explicit Ring(Work budget) : work_(budget) {}

    GeneratorId add_generator(Generator generator);
    [[nodiscard]] const Generator& generator(GeneratorId id) const { return generators_[id]; }
    [[nodiscard]] std::size_t size() const { return generators_.size(); }
    void restrict_range(GeneratorId id, const Range& range);
    void set_relation(GeneratorId id, unsigned power, Polynomial relation);
    /// generators[id] with this key, made by `make` on first use.
    template <class Make>
    GeneratorId keyed(const std::string& key, Make make)
    {
        if (const auto at = keys_.find(key); at != keys_.end()) return at->second;
        const GeneratorId id = make();
        keys_.emplace(key, id);
        return id;
    }

    // Polynomials modulo the relations.
    [[nodiscard]] Polynomial reduce(const Polynomial& p);
    [[nodiscard]] Polynomial times(const Polynomial& p, const Polynomial& q) { return reduce(multiply(p, q, work_)); }
    [[nodiscard]] Polynomial power(const Polynomial& p, unsigned exponent);

    // Fractions.
    [[nodiscard]] Fraction constant(const mpq_class& value) const;
    [[nodiscard]] Fraction of(const Polynomial& p) { return normalised({reduce(p), 1, {}}); }
    [[nodiscard]] Fraction of(GeneratorId id, unsigned exponent = 1) { return of(generator_polynomial(id, exponent)); }
    [[nodiscard]] Fraction add(const Fraction& a, const Fraction& b, int sign = 1);
    [[nodiscard]] Fraction times(const Fraction& a, const Fraction& b);
    [[nodiscard]] Fraction inverse(const Fraction& a); ///< VanishingDivisor where a is 0
    [[nodiscard]] Fraction divide(const Fraction& a, const Fraction& b) { return times(a, inverse(b)); }
    [[nodiscard]] Fraction power(const Fraction& a, int exponent);
    [[nodiscard]] Fraction negate(Fraction a) const;
    [[nodiscard]] const Polynomial& factor(std::size_t index) const { return factors_[index]; }
    /// p = content * product of known or new factors; appends to `into`. Content may be negative.
    [[nodiscard]] mpz_class split(const Polynomial& p, std::vector<std::pair<std::size_t, unsigned>>& into);

    // Signs on the domain.
    void add_fact(const Polynomial& p, const Signs& known);
    [[nodiscard]] Signs signs(const Polynomial& p);
    [[nodiscard]] Signs signs(const Fraction& a);
    /// Sharpens the ranges of generators by the facts; call once all facts are known.
    void propagate_facts();
    /// True where two facts exclude each other: no point satisfies all of them.
    [[nodiscard]] bool is_contradictory() const;
    [[nodiscard]] Range range_of(const Polynomial& p) const;
    /// An enclosure where every generator is a constant.
    [[nodiscard]] std::optional<Ball> value_of(const Polynomial& p) const;
    [[nodiscard]] std::optional<Ball> value_of(const Fraction& a) const;
    /// p with even powers of these cosines written by sines; an equal element of the ring.
    [[nodiscard]] std::vector<Polynomial> rewritings(const Polynomial& p);

    [[nodiscard]] Work& work() { return work_; }

    /// `a` with content and exactly dividing factors cancelled; its numerator must be reduced.
    [[nodiscard]] Fraction normalised(Fraction a);
    [[nodiscard]] std::size_t factor_index(const Polynomial& p); ///< p primitive, leading coefficient positive

  private:
    /// The divisors among these that are more than a generator without a relation, as a product of generators that
    /// stand for their inverses; the others stay in `factors` (as common denominators they add no terms).
    [[nodiscard]] Polynomial take_inverses(std::vector<std::pair<std::size_t, unsigned>>& factors);
    [[nodiscard]] Polynomial expand(const std::vector<std::pair<std::size_t, unsigned>>& factors);
    [[nodiscard]] const Polynomial& relation_power(GeneratorId id, unsigned exponent);
    [[nodiscard]] Signs signs(const Polynomial& p, int depth);
    [[nodiscard]] Signs simple_signs(const Polynomial& p, int depth);
    [[nodiscard]] Range term_range(const Term& term) const;
    [[nodiscard]] Signs value_signs(const Polynomial& p) const;
    void bound_by(const SignFact& fact);
    [[nodiscard]] Signs grouped_signs(const Polynomial& p, int depth);
    [[nodiscard]] Signs group_signs(GeneratorId id, const std::map<unsigned, Polynomial>& parts, int depth);
    [[nodiscard]] Signs quadratic_signs(const std::map<unsigned, Polynomial>& parts, int depth);
    [[nodiscard]] Signs root_signs(GeneratorId id, const std::map<unsigned, Polynomial>& parts, int depth);
    [[nodiscard]] Signs end_signs(const Polynomial& p, int depth);
    [[nodiscard]] Signs sum_signs(const Polynomial& p, const mpz_class& coefficient, const SignFact& fact, int depth);
    [[nodiscard]] Signs fact_signs(const Polynomial& p, int depth);

    Work work_;
    std::vector<Generator> generators_;
    std::map<std::string, GeneratorId> keys_;
    std::vector<Polynomial>
        factors_; ///< primitive, leading coefficient positive, no monomial content unless a generator
    std::map<std::string, std::size_t> factor_keys_;
    std::map<std::pair<GeneratorId, unsigned>, Polynomial> relation_powers_;
    std::vector<SignFact> facts_;
    std::size_t sign_steps_ = 0; ///< left of one question about signs
};

[[nodiscard]] std::string key_of(const Fraction& a);
[[nodiscard]] bool same(const Fraction& a, const Fraction& b);

} // namespace lagen::proof
