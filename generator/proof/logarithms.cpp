// SPDX-License-Identifier: GPL-2.0-or-later
/// Logarithms: numbers by their primes, exponentials undone, certainly positive factors and even powers split off.
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

namespace lagen::proof {

Fraction Elementary::log_generator(const Polynomial& p)
{
    const GeneratorId id = ring_.keyed("log:" + key_of(p), [&] {
        const Range range = is_constant(p) && p[0].coefficient > 1 ? Range::positive() : Range{};
        return ring_.add_generator({"log(" + to_text(ring_, p, 160) + ")", range, 0, {}, -1, false});
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
        // A root w >= 0 with w^q = r, and log w defined: log w = log(r) / q. (Not for |x|, a root of degree 2 of a
        // square.)
        if (generator.power > 0 && !generator.range.low.infinite && generator.text.compare(0, 4, "abs(") != 0) {
            const Fraction log = logarithm(ring_.of(generator.relation));
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
    if (!is_one(rest)) add_in(log_generator(rest), 1);
    return result;
}

} // namespace lagen::proof
