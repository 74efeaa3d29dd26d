// SPDX-License-Identifier: MIT
/// Exact coefficients. A tableau is a type with constexpr members: stages, order, a (rows of the strict lower triangle
/// one after another), b, c.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace lagen {

/// numerator / denominator, rounded once to the scalar (both must be below 2^53).
struct Fraction {
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;

    [[nodiscard]] constexpr bool is_zero() const noexcept { return numerator == 0; }

    /// How often `part` goes into this; 0 where that is no whole number other than 0 (or the numbers are large).
    [[nodiscard]] constexpr std::int64_t count_of(const Fraction& part) const noexcept
    {
        constexpr std::int64_t large = std::int64_t{1} << 31;
        for (const std::int64_t x : {numerator, denominator, part.numerator, part.denominator})
            if (x >= large || x <= -large) return 0;
        const std::int64_t above = numerator * part.denominator, below = denominator * part.numerator;
        return below != 0 && above % below == 0 ? above / below : 0;
    }

    template <class Real>
    [[nodiscard]] constexpr Real as() const noexcept
    {
        // A quotient of two exact doubles rounded to float is rounded correctly, one of two floats is not.
        if constexpr (std::is_same_v<Real, float>)
            return static_cast<float>(static_cast<double>(numerator) / static_cast<double>(denominator));
        else
            return static_cast<Real>(numerator) / static_cast<Real>(denominator);
    }
};

/// A coefficient that is published as a decimal fraction only; exact to the digits of a long double (19 on x86), also
/// where the scalar has more: methods made of Decimals (Tsit5, Dop853, McLachlan4, Yoshida6) satisfy their order
/// conditions to about 1e-18 in any wider scalar, those made of Fractions to all its digits.
struct Decimal {
    long double value = 0.0L;

    [[nodiscard]] constexpr bool is_zero() const noexcept { return value == 0.0L; }
    [[nodiscard]] constexpr std::int64_t count_of(const Decimal& part) const noexcept { return value == part.value; }

    template <class Real>
    [[nodiscard]] constexpr Real as() const noexcept
    {
        return static_cast<Real>(value);
    }
};

} // namespace lagen
