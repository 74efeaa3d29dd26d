// SPDX-License-Identifier: MIT
/// Exact coefficients. A tableau is a type with constexpr members: stages, order, a (rows of the strict lower triangle
/// one after another), b, c. Embedded pairs have more:
///
/// `end`: the stage, from 0, that stands at the end of the step; row `end` of a are the weights of the step. It is
/// evaluated before the error is known where it is one of the `stages`, else only after a step that is kept; its K is
/// the first one of the next step.
///
/// `dense_stages`: all stages; those behind `end` serve values inside the step and are evaluated where one is asked
/// for.
///
/// `error`: the weights minus those of the embedded formula, which is of order `embedded_order`.
///
/// `interpolant`: the weights at theta are b_i(theta) = sum_k interpolant[i][k] theta^(k + 1), of order `dense_order`.
///
/// Pairs for x'' = f have rows abar and weights bbar, error_bar of x (times h^2) beside a, b and error of x'; their
/// interpolant is that of x', and its integral that of x.
#pragma once

#include "lagen/requirements.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
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
/// where the scalar has more: a method made of Decimals (Tsit5) satisfies its order conditions to about 1e-18 in any
/// wider scalar, those made of Fractions to all its digits.
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

/// A coefficient to 40 digits: the sum of three doubles, the first of which is the double nearest to it.
struct Coefficient {
    double head = 0, tail = 0, rest = 0;

    [[nodiscard]] constexpr bool is_zero() const noexcept { return head == 0; }
    [[nodiscard]] constexpr std::int64_t count_of(const Coefficient& part) const noexcept
    {
        return head == part.head && tail == part.tail && rest == part.rest;
    }

    template <class Real>
    [[nodiscard]] constexpr Real as() const noexcept
    {
        if constexpr (std::numeric_limits<Real>::digits > std::numeric_limits<double>::digits)
            return Real(head) + (Real(tail) + Real(rest));
        else
            return static_cast<Real>(head);
    }
};

namespace splitting {

/// Coefficients as they stand.
template <std::size_t n>
constexpr std::array<Coefficient, n> listed(const std::array<Coefficient, n>& all) noexcept
{
    return all;
}

/// The palindrome that begins with `half`, the last entry of which is its middle.
template <std::size_t n>
constexpr std::array<Coefficient, 2 * n - 1> mirrored(const std::array<Coefficient, n>& half) noexcept
{
    std::array<Coefficient, 2 * n - 1> all{};
    for (std::size_t k = 0; k < n; ++k) all[k] = all[2 * n - 2 - k] = half[k];
    return all;
}

template <std::size_t n>
constexpr bool is_palindrome(const std::array<Coefficient, n>& all) noexcept
{
    for (std::size_t k = 0; k < n / 2; ++k)
        if (all[k].count_of(all[n - 1 - k]) != 1) return false;
    return true;
}

} // namespace splitting

namespace detail {

/// Does the interpolant use stage i?
template <class Tableau, std::size_t i>
constexpr bool is_interpolated() noexcept
{
    for (const auto& coefficient : Tableau::interpolant[i])
        if (!coefficient.is_zero()) return true;
    return false;
}

/// sum_k interpolant[i][k] theta^(k + 1).
template <class Tableau, std::size_t i, class Real>
[[gnu::always_inline]] inline Real interpolant_weight(const Real& theta) noexcept
{
    constexpr auto& row = Tableau::interpolant[i];
    Real sum = row.back().template as<Real>();
    for (std::size_t k = row.size() - 1; k-- > 0;) sum = row[k].template as<Real>() + theta * sum;
    return theta * sum;
}

/// Its integral from 0 to theta.
template <class Tableau, std::size_t i, class Real>
[[gnu::always_inline]] inline Real interpolant_integral(const Real& theta) noexcept
{
    constexpr auto& row = Tableau::interpolant[i];
    Real sum = Real(0);
    for (std::size_t k = row.size(); k-- > 0;)
        sum = row[k].template as<Real>() / static_cast<Real>(k + 2) + theta * sum;
    return theta * theta * sum;
}

} // namespace detail

} // namespace lagen
