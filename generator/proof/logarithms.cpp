// SPDX-License-Identifier: GPL-2.0-or-later
/// Logarithms: numbers by their primes, exponentials undone, certainly positive factors and even powers split off.
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

#include <cmath>

namespace lagen::proof {

constexpr int deepest_log = 6;

Range increasing_image(const Range& range, void (*f)(arb_t, const arb_t, slong))
{
    constexpr double steps = 1024, largest = 1e9;
    Range image;
    for (const bool upper : {false, true}) {
        const End& end = upper ? range.high : range.low;
        if (end.infinite) continue;
        Ball value(end.value, 64);
        f(value.get(), value.get(), 64);
        if (!value.is_finite() || value.bound() > largest) continue;
        arf_t bound;
        arf_init(bound);
        upper ? arb_get_ubound_arf(bound, value.get(), 64) : arb_get_lbound_arf(bound, value.get(), 64);
        const double scaled = steps * arf_get_d(bound, upper ? ARF_RND_CEIL : ARF_RND_FLOOR);
        arf_clear(bound);
        mpq_class rounded(upper ? std::ceil(scaled) : std::floor(scaled));
        rounded /= steps;
        (upper ? image.high : image.low) = End{false, rounded, false};
    }
    return image;
}

Fraction Elementary::log_generator(const Polynomial& p)
{
    const GeneratorId id = ring_.keyed("log:" + key_of(p), [&] {
        // log p > 0 where p > 1
        const Signs signs = ring_.signs(add_scaled(p, constant_polynomial(1), -1, ring_.work()));
        const Printed argument = print(ring_, p, longest_generator);
        Generator generator{"log(" + argument.text + ")", {}, 0, {}, -1, false};
        generator.tree = call_of(Function::log, {argument.tree});
        if (!signs.negative) generator.range.low = End{false, 0, !signs.zero};
        if (!signs.positive) generator.range.high = End{false, 0, !signs.zero};
        generator.range.nonzero = !signs.zero;
        generator.range = intersect(generator.range, increasing_image(ring_.range_of(p), arb_log));
        generator.value = ring_.value_of(p);
        if (generator.value) arb_log(generator.value->get(), generator.value->get(), 256);
        return ring_.add_generator(std::move(generator));
    });
    logs_.emplace(id, p);
    return ring_.of(id);
}

Fraction Elementary::number_logarithm(const mpq_class& number)
{
    Fraction result;
    const auto add_in = [&](const mpz_class& integer, int sign) {
        for (const auto& [prime, power] : small_factors(integer)) {
            const Fraction log = log_generator(constant_polynomial(prime));
            result = ring_.add(result, ring_.times(ring_.constant(mpq_class(power) * sign), log));
        }
    };
    add_in(number.get_num(), 1);
    add_in(number.get_den(), -1);
    return result;
}

/// log p of a certainly positive factor.
Fraction Elementary::factor_logarithm(const Polynomial& p)
{
    if (const Fraction* inner = exponent_of(p)) return *inner;
    if (p.size() == 1 && p[0].coefficient == 1 && p[0].monomial.size() == 1 && p[0].monomial.exponent(0) == 1) {
        const Generator generator = ring_.generator(p[0].monomial.generator(0));
        // A root w >= 0 with w^q = r, and log w defined: log w = log(r) / q.
        if (generator.power > 0 && !generator.range.low.infinite && !generator.is_absolute &&
            log_depth_ < deepest_log) {
            // Relations of coordinates may lead back to one another (x^2 = x*y): the depth is bounded.
            ++log_depth_;
            const Fraction log = logarithm(ring_.of(generator.relation));
            --log_depth_;
            return ring_.times(ring_.constant(mpq_class(1, generator.power)), log);
        }
    }
    return log_generator(p);
}

Fraction Elementary::logarithm(const Fraction& argument)
{
    if (argument.is_zero()) return opaque("log", {argument}); // defined nowhere
    const Factored parts = factored(argument);
    Fraction result = number_logarithm(parts.number);
    Polynomial rest = constant_polynomial(sgn(parts.number) < 0 ? -1 : 1);
    const auto add_in = [&](const Fraction& log, int times) {
        result = ring_.add(result, ring_.times(ring_.constant(times), log));
    };
    for (const auto& [base, exponent] : parts.factors) {
        const Signs signs = ring_.signs(base);
        if (signs.certainly_nonnegative()) {
            add_in(factor_logarithm(base), exponent);
            continue;
        }
        if (!signs.positive) {
            add_in(factor_logarithm(negate(base)), exponent);
            if (exponent % 2 != 0) rest = negate(std::move(rest));
            continue;
        }
        // log f^(2k) = 2k log|f|, and an odd power leaves one factor f^(+-1) behind, f being of the sign of the rest.
        const int odd = exponent % 2 != 0 ? 1 : 0;
        if (exponent - odd != 0) add_in(factor_logarithm(absolute(ring_.of(base)).num), exponent - odd);
        if (odd != 0) rest = ring_.times(rest, base);
    }
    if (is_one(rest)) return result;
    Polynomial square;
    if (rest.size() > 2 && square_root(rest, square, ring_.work())) {
        const Fraction magnitude = absolute(ring_.of(square));
        if (magnitude.is_polynomial() && magnitude.scale == 1) {
            add_in(factor_logarithm(magnitude.num), 2);
            return result;
        }
    }
    add_in(log_generator(rest), 1);
    return result;
}

bool Elementary::is_vanishing_logarithm(const Fraction& a)
{
    constexpr int highest_power = 64;
    struct Group {
        std::vector<std::pair<GeneratorId, int>> logs; ///< and their integer coefficients
        Fraction rest;
    };
    std::map<std::string, Group> groups;
    for (const Term& term : a.num) {
        const Monomial& monomial = term.monomial;
        std::size_t place = monomial.size();
        for (std::size_t k = 0; k < monomial.size(); ++k)
            if (logs_.count(monomial.generator(k)) > 0) place = k;
        if (place == monomial.size()) {
            Group& group = groups[key_of(Monomial())];
            group.rest = ring_.add(group.rest, ring_.of(Polynomial{term}));
            continue;
        }
        if (abs(term.coefficient) > highest_power || monomial.exponent(place) != 1) return false;
        const GeneratorId log = monomial.generator(place);
        groups[key_of(monomial.without(log))].logs.emplace_back(log, static_cast<int>(term.coefficient.get_si()));
    }
    for (const auto& [key, group] : groups) {
        if (group.logs.empty()) return false;
        Fraction product = exponential(group.rest);
        for (const auto& [log, times] : group.logs)
            product = ring_.times(product, ring_.power(ring_.of(logs_.at(log)), times));
        if (!ring_.add(product, ring_.constant(1), -1).is_zero()) return false;
    }
    return !groups.empty();
}

} // namespace lagen::proof
