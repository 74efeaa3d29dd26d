// SPDX-License-Identifier: GPL-2.0-or-later
/// Signs of ring elements on the whole domain: by the ranges of the generators, by polynomials that the domain makes
/// positive, and by perfect squares. Exact; "unknown" is always allowed.
#include "proof/ring.hpp"

#include <algorithm>

namespace lagen::proof {
namespace {

constexpr int deepest = 3;                  ///< products of facts that are looked through
constexpr std::size_t most_sign_steps = 80; ///< polynomials looked at for one question
constexpr std::size_t strict_steps = 12;    ///< further ones, where a fact says p >= 0 and only p = 0 is left open
constexpr std::size_t most_terms = 300;     ///< of a polynomial whose sign is asked for; rational ranges are slow

/// p over its positive content, so that positive multiples are equal.
Polynomial primitive(const Polynomial& p)
{
    return divide_content(p, content(p));
}

} // namespace

void Ring::add_fact(const Polynomial& p, const Signs& known)
{
    if (is_constant(p)) return;
    const Polynomial fact = primitive(p);
    facts_.push_back({fact, known});
    if (fact[0].monomial.size() != 1 || fact[0].monomial.exponent(0) != 1) return;
    const GeneratorId id = fact[0].monomial.generator(0);
    Range range;
    range.nonzero = fact.size() == 1 && !known.zero;
    const bool alone = fact.size() == 1 || (fact.size() == 2 && fact[1].monomial.is_one());
    if (alone && !known.negative) {
        // a g + b > 0 with numbers a, b bounds the generator g itself.
        mpq_class bound(fact.size() == 2 ? mpz_class(-fact[1].coefficient) : mpz_class(0), fact[0].coefficient);
        bound.canonicalize();
        (fact[0].coefficient > 0 ? range.low : range.high) = End{false, bound, !known.zero};
    }
    restrict_range(id, range);
}

/// From ranges and constants alone; further down in a question about signs, from facts and groups as well.
Signs Ring::simple_signs(const Polynomial& p, int depth)
{
    return depth < deepest ? signs(p, depth + 1) : signs_of(range_of(p));
}

/// Of p = l fact + rest, where the number l cancels the term that the two have in common.
Signs Ring::sum_signs(const Polynomial& p, const mpz_class& coefficient, const SignFact& fact, int depth)
{
    const mpz_class& lead = fact.polynomial[0].coefficient;
    const int sign = sgn(coefficient) * sgn(lead);
    const Polynomial rest = add_scaled(scale(p, abs(lead)), fact.polynomial, -abs(coefficient) * sign, work_);
    return (sign > 0 ? fact.signs : -fact.signs) + simple_signs(rest, depth);
}

Signs Ring::fact_signs(const Polynomial& p, int depth)
{
    Signs known;
    for (std::size_t k = 0; k < facts_.size(); ++k) {
        const SignFact fact = facts_[k];
        const Term& lead = fact.polynomial[0];
        Polynomial quotient;
        if (depth < deepest && divide_exactly(p, fact.polynomial, quotient, work_))
            known = both(known, fact.signs * signs(quotient, depth + 1));
        for (const Term& term : p)
            if (term.monomial == lead.monomial) known = both(known, sum_signs(p, term.coefficient, fact, depth));
    }
    return known;
}

/// A polynomial that is affine in a power of a bounded generator lies between its values at the two ends of the power.
Signs Ring::end_signs(const Polynomial& p, int depth)
{
    std::map<GeneratorId, std::pair<unsigned, bool>> degrees; // and whether no other exponent stands beside it
    for (const Term& term : p)
        for (std::size_t k = 0; k < term.monomial.size(); ++k) {
            const unsigned exponent = term.monomial.exponent(k);
            const auto [at, fresh] = degrees.try_emplace(term.monomial.generator(k), exponent, true);
            if (!fresh && at->second.first != exponent) at->second.second = false;
        }
    for (const auto& [id, degree] : degrees) {
        const Range range =
            degree.second && degree.first <= 4 ? proof::power(generators_[id].range, degree.first) : Range{};
        if (range.low.infinite || range.high.infinite) continue;
        Signs ends[2];
        for (int k = 0; k < 2; ++k) {
            const mpq_class& end = (k == 0 ? range.low : range.high).value;
            std::vector<Term> terms;
            for (const Term& term : p) {
                const bool has = term.monomial.exponent_of(id) > 0;
                const mpz_class factor = has ? end.get_num() : end.get_den();
                if (factor != 0) terms.push_back({term.monomial.without(id), term.coefficient * factor});
            }
            ends[k] = signs(collect(std::move(terms), work_), depth + 1);
        }
        // Between the ends p is a mean of both with positive weights.
        const Signs mean = ends[0] + ends[1];
        return {mean.negative || ends[0].negative || ends[1].negative, mean.zero || ends[0].zero || ends[1].zero,
                mean.positive || ends[0].positive || ends[1].positive};
    }
    return {};
}

std::vector<Polynomial> Ring::rewritings(const Polynomial& p)
{
    std::vector<GeneratorId> cosines;
    for (const Term& term : p)
        for (std::size_t k = 0; k < term.monomial.size(); ++k) {
            const GeneratorId id = term.monomial.generator(k);
            const bool known = std::find(cosines.begin(), cosines.end(), id) != cosines.end();
            const Generator& generator = generators_[id];
            if (!known && generator.partner >= 0 && !generator.is_sine && term.monomial.exponent(k) >= 2 &&
                cosines.size() < 8)
                cosines.push_back(id);
        }
    const auto rewritten = [this](const Polynomial& source, GeneratorId cosine) {
        const auto sine = static_cast<GeneratorId>(generators_[cosine].partner);
        const Polynomial relation = add_scaled(constant_polynomial(1), generator_polynomial(sine, 2), -1, work_);
        Polynomial result;
        for (const Term& term : source) {
            const unsigned exponent = term.monomial.exponent_of(cosine);
            Polynomial image{{term.monomial.without(cosine) * Monomial(cosine, exponent % 2), term.coefficient}};
            for (unsigned k = 0; k < exponent / 2; ++k) image = multiply(image, relation, work_);
            result = add_scaled(result, collect(std::move(image), work_), 1, work_);
        }
        return result;
    };
    std::vector<Polynomial> forms;
    Polynomial all = p;
    for (const GeneratorId cosine : cosines) {
        forms.push_back(rewritten(p, cosine));
        all = rewritten(all, cosine);
    }
    if (cosines.size() > 1) forms.push_back(all);
    return forms;
}

Signs Ring::signs(const Polynomial& p)
{
    sign_steps_ = most_sign_steps;
    return signs(p, 0);
}

Signs Ring::signs(const Polynomial& p, int depth)
{
    if (p.empty()) return {false, true, false};
    if (is_constant(p)) return signs_of(p[0].coefficient);
    if (p.size() > most_terms || sign_steps_ == 0) return {};
    --sign_steps_;
    work_.spend(10 * p.size());
    Signs known = both(signs_of(range_of(p)), value_signs(p));
    const auto settled = [&known] { return static_cast<int>(known.negative) + known.zero + known.positive <= 1; };
    if (settled()) return known;
    const Monomial common = monomial_content(p);
    if (!common.is_one() && p.size() > 1) {
        Signs product = signs(divide_monomial(p, common), depth);
        for (std::size_t k = 0; k < common.size(); ++k)
            product = product * proof::power(signs_of(generators_[common.generator(k)].range), common.exponent(k));
        return both(known, product);
    }
    for (const SignFact& fact : facts_)
        if (depth == 0 && fact.polynomial.size() == p.size() && equal(fact.polynomial, primitive(p))) {
            known = both(known, fact.signs);
            sign_steps_ = std::min(sign_steps_, strict_steps);
        }
    if (!settled()) known = both(known, fact_signs(p, depth));
    if (settled() || depth >= deepest) return known;
    Polynomial root;
    if (p.size() > 2 && square_root(primitive(p), root, work_))
        known = both(known, proof::power(signs(root, depth + 1), 2));
    if (!settled()) known = both(known, end_signs(p, depth));
    if (!settled()) known = both(known, grouped_signs(p, depth));
    if (settled() || depth > 0) return known;
    for (const Polynomial& form : rewritings(p))
        if (!settled()) known = both(known, signs(form, depth + 1));
    return known;
}

Signs Ring::signs(const Fraction& a)
{
    Signs known = signs(a.num);
    for (const auto& [index, exponent] : a.factors) {
        Signs factor = signs(Polynomial(factors_[index]));
        factor.zero = false; // a fraction speaks of the points where its denominator is not zero
        known = known * proof::power(factor, exponent);
    }
    return known;
}

// Signs of sums of groups: p = sum_k P_k g^k in one generator g, whose parts have signs of their own; quadratics by
// their discriminant, roots by their norm.

namespace {

constexpr std::size_t most_groups = 60; ///< terms of a polynomial that is split into groups

std::map<GeneratorId, std::map<unsigned, Polynomial>> groups_of(const Polynomial& p)
{
    std::map<GeneratorId, std::map<unsigned, Polynomial>> groups;
    for (const Term& term : p)
        for (std::size_t k = 0; k < term.monomial.size(); ++k) groups[term.monomial.generator(k)];
    for (auto& [id, parts] : groups)
        // Descending order survives the removal of one generator from terms that share its exponent.
        for (const Term& term : p)
            parts[term.monomial.exponent_of(id)].push_back({term.monomial.without(id), term.coefficient});
    return groups;
}

bool settled(const Signs& known)
{
    return static_cast<int>(known.negative) + known.zero + known.positive <= 1;
}

} // namespace

Signs Ring::grouped_signs(const Polynomial& p, int depth)
{
    Signs known;
    if (p.size() > most_groups) return known;
    const auto groups = groups_of(p);
    // Quadratics and roots first: they lose nothing.
    for (const auto& [id, parts] : groups) {
        if (settled(known)) return known;
        if (parts.rbegin()->first == 2 && parts.size() == 3) known = both(known, quadratic_signs(parts, depth));
        known = both(known, root_signs(id, parts, depth));
    }
    for (const auto& [id, parts] : groups)
        if (!settled(known) && parts.size() == 2) known = both(known, group_signs(id, parts, depth));
    return known;
}

/// sum_k P_k g^k by the signs of the parts.
Signs Ring::group_signs(GeneratorId id, const std::map<unsigned, Polynomial>& parts, int depth)
{
    const Signs base = signs_of(generators_[id].range);
    Signs sum{false, true, false};
    for (const auto& [exponent, part] : parts) {
        const Signs power = exponent == 0 ? Signs{false, false, true} : proof::power(base, exponent);
        sum = sum + signs(part, depth + 1) * power;
        if (sum.negative && sum.positive) return {};
    }
    return sum;
}

/// p = A g^2 + B g + C: 4 A p = (2 A g + B)^2 + (4 A C - B^2).
Signs Ring::quadratic_signs(const std::map<unsigned, Polynomial>& parts, int depth)
{
    const auto part = [&parts](unsigned exponent) {
        const auto at = parts.find(exponent);
        return at == parts.end() ? Polynomial() : at->second;
    };
    const Polynomial A = part(2), B = part(1), C = part(0);
    const Signs leading = signs(A, depth + 1);
    if (leading.negative && leading.positive) return {};
    const Polynomial product = scale(times(A, C), 4);
    const Signs gap = signs(add_scaled(product, times(B, B), -1, work_), depth + 1);
    if (gap.negative) return {};
    // 4 A C > B^2 says that A is not 0; 4 A C >= B^2 alone needs A != 0.
    if (gap.zero && leading.zero) return {};
    const Signs upward{false, gap.zero, true};
    return leading.negative ? -upward : upward;
}

/// p = A + B w^k where w >= 0 is a root, w^q = r. For even q = 2 k and A, B of opposite signs, p (A - B w^k) = A^2 -
/// B^2 r; for odd q the power q is monotone, sign p = sign(A^q + B^q r^k).
Signs Ring::root_signs(GeneratorId id, const std::map<unsigned, Polynomial>& parts, int depth)
{
    const Generator generator = generators_[id];
    if (parts.size() != 2 || parts.begin()->first != 0) return {};
    if (generator.power < 2 || generator.power > 6 || generator.is_sine) return {};
    const auto& [k, B] = *parts.rbegin();
    const Polynomial& A = parts.begin()->second;
    if (generator.power % 2 != 0) {
        const Polynomial image = times(power(B, generator.power), power(generator.relation, k));
        return signs(add_scaled(power(A, generator.power), image, 1, work_), depth + 1);
    }
    if (2 * k != generator.power || generator.range.low.infinite || sgn(generator.range.low.value) < 0) return {};
    const Signs a = signs(A, depth + 1), b = signs(B, depth + 1);
    const bool falling = !a.negative && !b.positive, rising = !a.positive && !b.negative;
    if (!falling && !rising) return {};
    const Polynomial image = times(power(B, 2), generator.relation);
    const Signs norm = signs(add_scaled(power(A, 2), image, -1, work_), depth + 1);
    return falling ? norm : -norm;
}

} // namespace lagen::proof
