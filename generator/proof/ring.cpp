// SPDX-License-Identifier: GPL-2.0-or-later
/// Generators and reduction modulo their relations.
#include "proof/ring.hpp"

#include <algorithm>

namespace lagen::proof {

GeneratorId Ring::add_generator(Generator generator)
{
    if (generators_.size() >= 0xffffU) throw BudgetExhausted("more than 65535 generators");
    generators_.push_back(std::move(generator));
    return static_cast<GeneratorId>(generators_.size() - 1);
}

void Ring::restrict_range(GeneratorId id, const Range& range)
{
    generators_[id].range = intersect(generators_[id].range, range);
}

void Ring::set_relation(GeneratorId id, unsigned power, Polynomial relation)
{
    generators_[id].power = power;
    generators_[id].relation = std::move(relation);
}

const Polynomial& Ring::relation_power(GeneratorId id, unsigned exponent)
{
    const auto key = std::pair(id, exponent);
    if (const auto at = relation_powers_.find(key); at != relation_powers_.end()) return at->second;
    const Polynomial relation = generators_[id].relation;
    Polynomial value = exponent == 1 ? reduce(relation) : power(relation, exponent);
    return relation_powers_.emplace(key, std::move(value)).first->second;
}

Polynomial Ring::reduce(const Polynomial& p)
{
    const auto reducible = [this](const Monomial& m) {
        for (std::size_t k = m.size(); k-- > 0;) {
            const unsigned power = generators_[m.generator(k)].power;
            if (power > 0 && m.exponent(k) >= power) return true;
        }
        return false;
    };
    Polynomial done, todo;
    for (const Term& term : p) (reducible(term.monomial) ? todo : done).push_back(term);
    // Terms with the same powers to replace are gathered, so that each power is multiplied in once.
    while (!todo.empty()) {
        std::map<Monomial, Polynomial, Before> groups; ///< by the powers that are replaced
        for (const Term& term : todo) {
            Monomial rest, replaced;
            for (std::size_t k = 0; k < term.monomial.size(); ++k) {
                const GeneratorId id = term.monomial.generator(k);
                const unsigned power = generators_[id].power, exponent = term.monomial.exponent(k);
                const unsigned quotient = power == 0 ? 0 : exponent / power;
                if (quotient > 0) replaced = replaced * Monomial(id, quotient);
                rest = rest * Monomial(id, exponent - quotient * power);
            }
            groups[replaced].push_back({rest, term.coefficient});
        }
        todo.clear();
        for (auto& [powers, group] : groups) {
            Polynomial product = collect(std::move(group), work_);
            for (std::size_t k = 0; k < powers.size(); ++k)
                product = multiply(product, relation_power(powers.generator(k), powers.exponent(k)), work_);
            Polynomial ready, again;
            for (Term& term : product) (reducible(term.monomial) ? again : ready).push_back(std::move(term));
            done = add_scaled(done, ready, 1, work_);
            todo = add_scaled(todo, again, 1, work_);
        }
    }
    return done;
}

Polynomial Ring::power(const Polynomial& p, unsigned exponent)
{
    Polynomial result = constant_polynomial(1), square = p;
    for (unsigned rest = exponent; rest > 0; rest >>= 1) {
        if (rest & 1U) result = times(result, square);
        if (rest > 1) square = times(square, square);
    }
    return result;
}

// Fractions over the ring: sums over the least common multiple of the factors, cancellation by trial division.

namespace {

using Factors = std::vector<std::pair<std::size_t, unsigned>>;

/// Merges two multisets; `combine` receives the powers (0 where absent).
template <class Combine>
Factors merge(const Factors& a, const Factors& b, Combine combine)
{
    Factors result;
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
        const bool from_a = j == b.size() || (i < a.size() && a[i].first <= b[j].first);
        const bool from_b = i == a.size() || (j < b.size() && b[j].first <= a[i].first);
        const std::size_t index = from_a ? a[i].first : b[j].first;
        const unsigned power = combine(from_a ? a[i].second : 0U, from_b ? b[j].second : 0U);
        if (power > 0) result.emplace_back(index, power);
        i += from_a ? 1 : 0;
        j += from_b ? 1 : 0;
    }
    return result;
}

unsigned missing(unsigned whole, unsigned part)
{
    return whole - std::min(whole, part);
}

} // namespace

std::optional<mpq_class> Fraction::constant() const
{
    if (!factors.empty() || !proof::is_constant(num)) return std::nullopt;
    mpq_class value(num.empty() ? mpz_class(0) : num[0].coefficient, scale);
    value.canonicalize();
    return value;
}

std::string key_of(const Fraction& a)
{
    std::string key = key_of(a.num) + '/' + a.scale.get_str();
    for (const auto& [index, power] : a.factors) key += 'f' + std::to_string(index) + '^' + std::to_string(power);
    if (key.size() > 1'000'000) throw BudgetExhausted("an argument is longer than 1000000 characters");
    return key;
}

bool same(const Fraction& a, const Fraction& b)
{
    return a.scale == b.scale && a.factors == b.factors && equal(a.num, b.num);
}

Fraction Ring::constant(const mpq_class& value) const
{
    return {constant_polynomial(value.get_num()), value.get_den(), {}};
}

Fraction Ring::negate(Fraction a) const
{
    a.num = proof::negate(std::move(a.num));
    return a;
}

std::size_t Ring::factor_index(const Polynomial& p)
{
    const auto [at, fresh] = factor_keys_.try_emplace(key_of(p), factors_.size());
    if (fresh) factors_.push_back(p);
    return at->second;
}

mpz_class Ring::split(const Polynomial& p, Factors& into)
{
    mpz_class unit = content(p);
    if (p[0].coefficient < 0) unit = -unit;
    Polynomial rest = divide_content(p, unit);
    const Monomial common = monomial_content(rest);
    Factors found;
    const auto record = [&found](std::size_t index, unsigned power) {
        for (auto& entry : found)
            if (entry.first == index) {
                entry.second += power;
                return;
            }
        found.emplace_back(index, power);
    };
    for (std::size_t k = 0; k < common.size(); ++k)
        record(factor_index(generator_polynomial(common.generator(k))), common.exponent(k));
    rest = divide_monomial(std::move(rest), common);
    Polynomial quotient;
    // Newer factors first: they are the products that the sums of a moment ago made.
    for (std::size_t index = factors_.size(); index-- > 0 && !is_constant(rest);)
        while (factors_[index].size() > 1 && divide_exactly(rest, factors_[index], quotient, work_)) {
            record(index, 1);
            rest = quotient;
        }
    // What is left of a primitive polynomial with a positive leading coefficient is 1 or a factor of its own.
    if (!is_constant(rest)) record(factor_index(rest), 1);
    std::sort(found.begin(), found.end());
    into = merge(into, found, [](unsigned a, unsigned b) { return a + b; });
    return unit;
}

Polynomial Ring::expand(const Factors& factors)
{
    Polynomial product = constant_polynomial(1);
    for (const auto& [index, exponent] : factors) {
        const Polynomial base = factors_[index];
        product = times(product, power(base, exponent));
    }
    return product;
}

Fraction Ring::normalised(Fraction a)
{
    if (a.num.empty()) return {};
    Factors left;
    for (auto [index, exponent] : a.factors) {
        const Polynomial& factor = factors_[index];
        Polynomial quotient;
        while (exponent > 0 && divide_exactly(a.num, factor, quotient, work_)) {
            a.num.swap(quotient);
            --exponent;
        }
        if (exponent > 0) left.emplace_back(index, exponent);
    }
    a.factors = std::move(left);
    mpz_class common = content(a.num);
    mpz_gcd(common.get_mpz_t(), common.get_mpz_t(), a.scale.get_mpz_t());
    if (common != 1) {
        a.num = divide_content(std::move(a.num), common);
        a.scale /= common;
    }
    return a;
}

Fraction Ring::add(const Fraction& a, const Fraction& b, int sign)
{
    if (b.is_zero()) return a;
    if (a.is_zero()) return sign < 0 ? negate(b) : b;
    mpz_class scale;
    mpz_lcm(scale.get_mpz_t(), a.scale.get_mpz_t(), b.scale.get_mpz_t());
    const mpz_class scale_a = scale / a.scale, scale_b = scale / b.scale * sign;
    if (a.factors == b.factors) {
        Fraction sum{add_scaled(proof::scale(a.num, scale_a), b.num, scale_b, work_), scale, a.factors};
        return normalised(std::move(sum));
    }
    Factors all = merge(a.factors, b.factors, [](unsigned x, unsigned y) { return std::max(x, y); });
    const Polynomial left = times(a.num, expand(merge(all, a.factors, missing)));
    const Polynomial right = times(b.num, expand(merge(all, b.factors, missing)));
    Fraction sum{add_scaled(proof::scale(left, scale_a), right, scale_b, work_), scale, std::move(all)};
    return normalised(std::move(sum));
}

Fraction Ring::times(const Fraction& a, const Fraction& b)
{
    if (a.is_zero() || b.is_zero()) return {};
    Fraction product;
    product.num = times(a.num, b.num);
    product.scale = a.scale * b.scale;
    product.factors = merge(a.factors, b.factors, [](unsigned x, unsigned y) { return x + y; });
    return normalised(std::move(product));
}

Polynomial Ring::take_inverses(Factors& factors)
{
    Polynomial product = constant_polynomial(1);
    Factors plain;
    for (const auto& [index, exponent] : factors) {
        const Polynomial& factor = factors_[index];
        if (factor.size() == 1 && generator(factor[0].monomial.generator(0)).power == 0) {
            plain.emplace_back(index, exponent);
            continue;
        }
        const GeneratorId id = keyed("inverse:" + std::to_string(index), [this, index = index] {
            Range range;
            const Signs known = signs(Polynomial(factors_[index]));
            if (!known.negative) range = Range::positive();
            range.nonzero = true;
            return add_generator({"(1/divisor " + std::to_string(index) + "...)", range, 0, {}, -1, false});
        });
        product = times(product, generator_polynomial(id, exponent));
    }
    factors = std::move(plain);
    return product;
}

Fraction Ring::inverse(const Fraction& a)
{
    if (a.is_zero()) throw VanishingDivisor("division by an expression that is identically zero");
    Fraction result;
    const mpz_class unit = split(a.num, result.factors);
    result.num = proof::scale(expand(a.factors), sgn(unit) < 0 ? mpz_class(-a.scale) : a.scale);
    result.scale = abs(unit);
    if (work_.divisors_apart) result.num = times(result.num, take_inverses(result.factors));
    return normalised(std::move(result));
}

Fraction Ring::power(const Fraction& a, int exponent)
{
    if (exponent < 0) return power(inverse(a), exponent == INT32_MIN ? INT32_MAX : -exponent);
    Fraction result;
    result.num = power(a.num, static_cast<unsigned>(exponent));
    const mpz_class bits = a.scale;
    if (mpz_sizeinbase(bits.get_mpz_t(), 2) * static_cast<std::size_t>(exponent) > 100'000 && bits != 1)
        throw BudgetExhausted("a coefficient exceeds 100000 bits");
    mpz_pow_ui(result.scale.get_mpz_t(), a.scale.get_mpz_t(), static_cast<unsigned long>(exponent));
    for (const auto& [index, power] : a.factors) {
        const std::uint64_t total = static_cast<std::uint64_t>(power) * static_cast<std::uint64_t>(exponent);
        if (total > 0xffffU) throw BudgetExhausted("an exponent exceeds 65535");
        result.factors.emplace_back(index, static_cast<unsigned>(total));
    }
    return normalised(std::move(result));
}

} // namespace lagen::proof
