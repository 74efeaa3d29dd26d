// SPDX-License-Identifier: GPL-2.0-or-later
/// Elementary functions of fractions as ring elements. Arguments of sin, cos and exp are split into rational multiples
/// of "atoms" (power products over a denominator); each atom has one unit, and the addition theorems do the rest. Roots
/// are generators w with w^q = radicand; |p| is a generator with square p^2; log splits off what is certainly positive.
/// Every rule holds wherever its argument is defined and the domain holds; what no rule covers becomes a free generator
/// keyed by its arguments, which can only miss zeros.
#pragma once

#include "proof/ring.hpp"

#include <set>

namespace lagen::proof {

/// How cos(a + b) is seen: by the addition theorem, or as a generator of the whole angle (better for signs).
enum class Angles { split, whole };

/// Bounds of f on a range, from its ends to about three decimals; f is increasing, as arb_log and arb_exp are.
[[nodiscard]] Range increasing_image(const Range& range, void (*f)(arb_t, const arb_t, slong));

/// A sign assumed of a polynomial, which is a tree so that every ring of the distinction knows it.
struct Assumption {
    Tree polynomial;
    Signs signs;
};
/// One case of a distinction.
using Assumptions = std::vector<Assumption>;

/// A sign that a normal form would have needed.
struct OpenSign {
    Tree polynomial;
    bool zero_apart = false;             ///< 0 is a case of its own; else it belongs to both signs
    std::optional<GeneratorId> absolute; ///< the generator that stands for the absolute value
};

class Elementary {
  public:
    explicit Elementary(Ring& ring, Angles angles = Angles::split, Assumptions assumptions = {})
        : ring_(ring), angles_(angles), assumptions_(std::move(assumptions))
    {
    }

    /// The number; `text` is its name from the first call on.
    [[nodiscard]] Fraction pi(const char* text = "pi");
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
    /// c_order(argument).
    [[nodiscard]] Fraction stumpff(unsigned order, const Fraction& argument);
    /// An argument of stumpff by which it divided, although it may vanish on a whole component of the points; empty:
    /// none.
    [[nodiscard]] const std::string& condition() const { return condition_; }
    /// From now on the Stumpff functions that occur stay generators: a constraint is solved in terms of them.
    void keep_families();
    /// A function of its own: odd, between -1 and 1, 0 at 0 alone.
    [[nodiscard]] Fraction error_function(const Fraction& a);
    [[nodiscard]] Fraction arcsine(const Fraction& a);
    [[nodiscard]] Fraction arccosine(const Fraction& a);
    [[nodiscard]] Fraction arctangent(const Fraction& a);
    [[nodiscard]] Fraction arctangent2(const Fraction& y, const Fraction& x);
    /// True where the angle a is 0, by cos a = 1 and |a| < 2 pi.
    [[nodiscard]] bool is_vanishing_angle(const Fraction& a);
    /// True where a sum of logarithms with the same cofactors, and of other terms, is 0 because its exponential is 1.
    [[nodiscard]] bool is_vanishing_logarithm(const Fraction& a);
    /// What is known of the sign of a, assumptions included; a sign that stays open is listed in `open_signs`.
    [[nodiscard]] Signs sign_of(const Fraction& a);
    [[nodiscard]] const std::vector<OpenSign>& open_signs() const { return open_signs_; }
    [[nodiscard]] Fraction opaque(const std::string& name, const std::vector<Fraction>& arguments);

    /// True once a unit became finer or a root known, so that results made before no longer meet those made now;
    /// resets.
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
    struct StumpffPair {
        Fraction even, odd; ///< c_0 and c_1
    };
    struct Family {
        mpq_class size;    ///< argument = size^2 * kernel
        Fraction argument; ///< of `first`
        StumpffPair first;
        bool kept = false; ///< although a root of its argument may be known by now
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
    [[nodiscard]] StumpffPair stumpff_pair(const Fraction& z);
    [[nodiscard]] StumpffPair repeated(const Family& family, const mpz_class& count);
    void forget_families();
    void make_family(Family& family, const Fraction& kernel);
    [[nodiscard]] std::optional<Fraction> argument_root(const Fraction& z, int sign);
    [[nodiscard]] std::optional<Fraction> known_root(const Fraction& z);
    [[nodiscard]] bool is_dense_where_nonzero(const Fraction& z);
    void divide_by_argument(const Fraction& z);
    [[nodiscard]] Fraction number_root(const mpq_class& number, unsigned degree);
    [[nodiscard]] Fraction root_generator(const Polynomial& radicand, unsigned degree);
    [[nodiscard]] Fraction remaining_root(const Polynomial& radicand, unsigned degree);
    [[nodiscard]] std::optional<Fraction> denested(const Polynomial& radicand);
    [[nodiscard]] Fraction open_absolute(const Polynomial& p);
    [[nodiscard]] Fraction absolute_generator(const Polynomial& p);
    /// The assumed sign of p, made a fact of the ring at the first use; nothing where p has no assumption.
    [[nodiscard]] std::optional<Signs> assumed(const Polynomial& p, const Tree& tree);
    void eliminate(const Polynomial& p);
    [[nodiscard]] Fraction inverse_angle(const std::string& name, const std::vector<Fraction>& arguments,
                                         const SineCosine& values, const Range& range);
    [[nodiscard]] std::optional<SineCosine> inverse_values(const Part& part);
    [[nodiscard]] SineCosine multiple_angle(SineCosine square, const mpz_class& multiple, const std::string& text);
    [[nodiscard]] Range angle_range(const Fraction& argument, bool sine);
    [[nodiscard]] Fraction number_logarithm(const mpq_class& number);
    [[nodiscard]] Fraction factor_logarithm(const Polynomial& p);
    [[nodiscard]] Fraction log_generator(const Polynomial& p);
    [[nodiscard]] const Fraction* exponent_of(const Polynomial& p) const; ///< of a single exp generator, else nullptr

    Ring& ring_;
    Angles angles_;
    bool refined_ = false;
    int log_depth_ = 0; ///< logarithms of relations that wait for one another
    std::map<std::string, Unit> angle_units_;
    std::map<std::string, Unit> exponential_units_;
    std::map<std::string, Family> families_; ///< of Stumpff functions
    std::string condition_;
    std::map<GeneratorId, Fraction> exponents_; ///< of exp generators
    struct Root {
        Polynomial radicand;
        unsigned degree = 2;
    };
    std::map<std::string, unsigned> root_degrees_; ///< by radicand: the common degree of its roots
    std::map<GeneratorId, Root> roots_;            ///< root generators
    std::map<GeneratorId, SineCosine> inverses_;   ///< sine and cosine of asin, atan, atan2 generators
    std::set<GeneratorId> halved_;                 ///< those in [-pi/2, pi/2]
    Assumptions assumptions_;
    std::set<std::size_t> applied_; ///< assumptions that are facts of the ring by now
    std::vector<OpenSign> open_signs_;
    std::map<GeneratorId, Polynomial> logs_; ///< arguments of log generators
};

/// Longest text of what stands in the name of a generator.
inline constexpr std::size_t longest_generator = 160;

/// The greatest rational that divides both.
[[nodiscard]] mpq_class common_divisor(const mpq_class& a, const mpq_class& b);

/// Longest text of a polynomial whose sign may be assumed.
inline constexpr std::size_t longest_open = 600;

/// The primes of |number| up to a bound, with multiplicities, and what is left (1, or a number without small primes).
[[nodiscard]] std::vector<std::pair<mpz_class, unsigned>> small_factors(const mpz_class& number);

} // namespace lagen::proof
