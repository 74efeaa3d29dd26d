// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/core/exact_rules.hpp"

#include "expression/special_angles.hpp"

namespace lagen::rules {

Exact exact_quotient(const Rational& a, const Rational& b)
{
    if (sgn(b) == 0) return std::nullopt;
    return Rational(a / b);
}

Exact exact_power(const Rational& a, std::int64_t exponent, std::size_t most_bits)
{
    const auto magnitude = static_cast<std::size_t>(exponent < 0 ? -exponent : exponent);
    if (magnitude != 0 && bits_of(a) > most_bits / magnitude && a != 0 && abs(a) != 1) return std::nullopt;
    Rational result;
    mpz_pow_ui(result.get_num_mpz_t(), a.get_num_mpz_t(), magnitude);
    mpz_pow_ui(result.get_den_mpz_t(), a.get_den_mpz_t(), magnitude);
    return exponent < 0 ? exact_quotient(1, result) : Exact(result);
}

Exact exact_root(const Rational& a)
{
    return rational_root(a);
}

Exact exact_at(const Rational& a, long point, long value)
{
    return a == point ? Exact(value) : std::nullopt;
}

Exact exact_truth(bool condition)
{
    return Rational(condition ? 1 : 0);
}

} // namespace lagen::rules
