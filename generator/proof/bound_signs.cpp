// SPDX-License-Identifier: GPL-2.0-or-later
/// What facts say of single generators: bounds from inequalities by interval propagation, and values of constants by
/// certified enclosures.
#include "proof/ring.hpp"

namespace lagen::proof {

namespace {

constexpr slong precision = 256;           ///< bits of the enclosures of constants
constexpr int passes = 3;                  ///< of propagation; each fact may sharpen what another one uses
constexpr std::size_t longest_fact = 12;   ///< terms of a fact that is propagated
constexpr std::size_t longest_bound = 256; ///< bits of a bound

/// A rational r >= |v|^(1/k) (above) or <= (below), exact where the root is rational.
mpq_class rational_root(const mpq_class& v, unsigned k, bool above)
{
    // Scaled so that the integer root keeps 20 bits.
    mpz_class scale = 1;
    mpz_mul_2exp(scale.get_mpz_t(), scale.get_mpz_t(), 20UL);
    mpz_class scale_power, numerator, root;
    mpz_root(root.get_mpz_t(), v.get_num_mpz_t(), k);
    mpz_class root_below;
    mpz_root(root_below.get_mpz_t(), v.get_den_mpz_t(), k);
    mpz_class check, check_below;
    mpz_pow_ui(check.get_mpz_t(), root.get_mpz_t(), k);
    mpz_pow_ui(check_below.get_mpz_t(), root_below.get_mpz_t(), k);
    if (check == v.get_num() && check_below == v.get_den()) return mpq_class(root, root_below);
    mpz_pow_ui(scale_power.get_mpz_t(), scale.get_mpz_t(), k);
    numerator = v.get_num() * scale_power;
    mpz_fdiv_q(numerator.get_mpz_t(), numerator.get_mpz_t(), v.get_den_mpz_t());
    mpz_root(root.get_mpz_t(), numerator.get_mpz_t(), k);
    if (above) root += 1;
    mpq_class result(root, scale);
    result.canonicalize();
    return result;
}

/// The values of g where g^k lies at or above `bound`, k odd; or below an upper bound of either parity.
std::optional<Range> root_range(const End& low, const End& high, unsigned k)
{
    Range range;
    if (!high.infinite && k % 2 == 0) {
        if (sgn(high.value) <= 0) return std::nullopt;
        const mpq_class root = rational_root(high.value, k, true);
        const bool open = high.open;
        range.low = End{false, -root, open};
        range.high = End{false, root, open};
        return range;
    }
    if (k % 2 == 0) return std::nullopt;
    if (!low.infinite && sgn(low.value) >= 0)
        range.low = End{false, sgn(low.value) == 0 ? mpq_class(0) : rational_root(low.value, k, false), low.open};
    else if (!low.infinite)
        range.low = End{false, -rational_root(-low.value, k, true), low.open};
    if (!high.infinite && sgn(high.value) <= 0)
        range.high = End{false, sgn(high.value) == 0 ? mpq_class(0) : -rational_root(-high.value, k, false), high.open};
    else if (!high.infinite)
        range.high = End{false, rational_root(high.value, k, true), high.open};
    return range;
}

} // namespace

Range Ring::term_range(const Term& term) const
{
    Range range = Range::point(mpq_class(term.coefficient));
    for (std::size_t k = 0; k < term.monomial.size(); ++k)
        range = range * proof::power(generators_[term.monomial.generator(k)].range, term.monomial.exponent(k));
    return range;
}

Range Ring::range_of(const Polynomial& p) const
{
    Range sum = Range::point(0);
    for (const Term& term : p) sum = p.size() == 1 ? term_range(term) : sum + term_range(term);
    return sum;
}

/// fact = c g^k + rest > 0 or >= 0: c g^k lies above minus the greatest value of the rest.
void Ring::bound_by(const SignFact& fact)
{
    if (fact.signs.negative || fact.polynomial.size() > longest_fact) return;
    std::vector<Range> ranges;
    for (const Term& term : fact.polynomial) ranges.push_back(term_range(term));
    for (std::size_t j = 0; j < ranges.size(); ++j) {
        const Term& term = fact.polynomial[j];
        if (term.monomial.size() != 1) continue;
        Range rest = Range::point(0);
        for (std::size_t k = 0; k < ranges.size(); ++k)
            if (k != j) rest = rest + ranges[k];
        if (rest.high.infinite) continue;
        mpq_class bound = -rest.high.value / mpq_class(term.coefficient);
        bound.canonicalize();
        if (bits_of(bound) > longest_bound) continue;
        const End end{false, bound, rest.high.open || !fact.signs.zero};
        const bool positive = term.coefficient > 0;
        const auto range = root_range(positive ? end : End{}, positive ? End{} : end, term.monomial.exponent(0));
        if (range) restrict_range(term.monomial.generator(0), *range);
    }
}

void Ring::propagate_facts()
{
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t k = 0; k < facts_.size(); ++k) {
            bound_by(facts_[k]);
            if (!facts_[k].signs.positive) bound_by({proof::negate(facts_[k].polynomial), -facts_[k].signs});
        }
        for (std::size_t k = 0; k < generators_.size(); ++k) {
            const Generator& generator = generators_[k];
            if (generator.power == 0 || generator.power % 2 != 0) continue;
            const Range square = range_of(generator.relation);
            if (const auto range = root_range(End{}, square.high, generator.power); range && !square.high.infinite)
                restrict_range(static_cast<GeneratorId>(k), *range);
        }
    }
}

bool Ring::is_contradictory() const
{
    for (const SignFact& fact : facts_) {
        const Signs left = both(fact.signs, signs_of(range_of(fact.polynomial)));
        if (!left.negative && !left.zero && !left.positive) return true;
    }
    return false;
}

std::optional<Ball> Ring::value_of(const Polynomial& p) const
{
    Ball sum;
    arb_zero(sum.get());
    for (const Term& term : p) {
        Ball product(mpq_class(term.coefficient), precision);
        for (std::size_t k = 0; k < term.monomial.size(); ++k) {
            const Generator& generator = generators_[term.monomial.generator(k)];
            if (!generator.value) return std::nullopt;
            Ball power;
            arb_pow_ui(power.get(), generator.value->get(), term.monomial.exponent(k), precision);
            arb_mul(product.get(), product.get(), power.get(), precision);
        }
        arb_add(sum.get(), sum.get(), product.get(), precision);
    }
    return sum;
}

std::optional<Ball> Ring::value_of(const Fraction& a) const
{
    std::optional<Ball> value = value_of(a.num);
    if (!value) return std::nullopt;
    const Ball scale(mpq_class(a.scale), precision);
    arb_div(value->get(), value->get(), scale.get(), precision);
    for (const auto& [index, exponent] : a.factors) {
        std::optional<Ball> factor = value_of(factors_[index]);
        if (!factor) return std::nullopt;
        arb_pow_ui(factor->get(), factor->get(), exponent, precision);
        arb_div(value->get(), value->get(), factor->get(), precision);
    }
    return value;
}

Signs Ring::value_signs(const Polynomial& p) const
{
    const std::optional<Ball> value = value_of(p);
    if (!value || !value->excludes_zero()) return {};
    const bool positive = value->is_positive();
    return {!positive, false, positive};
}

} // namespace lagen::proof
