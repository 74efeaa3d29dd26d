// SPDX-License-Identifier: MIT
/// Powers of positive numbers, of which lengths of steps are made: x^y within 1e-12 of itself, so long as it is a
/// normal number. Of float and double, the bits do not depend on the library, nor on whether a number is alone or a
/// lane of a pack; other scalars call their own pow.
#pragma once

#include "lagen/ensemble/pack.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace lagen::detail {

/// N numbers, a vector where there are several.
template <int N>
struct PowerLanes {
    using Real = std::conditional_t<N == 1, double, typename VectorOf<double, N>::type>;
    using Integer = std::conditional_t<N == 1, std::int64_t, typename VectorOf<std::int64_t, N>::type>;

    /// x = 2^e m with m within sqrt(1/2) .. sqrt(2); log2 x = e + 2/ln 2 artanh((m - 1)/(m + 1)), whose series ends
    /// with an error of 1e-15; 2^z = 2^n e^(f ln 2), |f| <= 1/2, with one of 3e-14. No sum has two products, so that a
    /// compiler that contracts has one way to do it.
    [[nodiscard]] [[gnu::always_inline]] static inline Real power(const Real& x, const Real& y) noexcept
    {
        constexpr double to_integer = 0x1.8p52; // its lowest bits are those of a whole number that is added
        constexpr std::int64_t whole = std::bit_cast<std::int64_t>(to_integer);
        const Integer bits = cast<Integer>(x), exponent = (bits - 0x3fe6a09e667f3bcd) >> 52;
        const Real m = cast<Real>(Integer(bits - (exponent << 52)));
        const Real e = cast<Real>(Integer(exponent + whole)) - to_integer;
        const Real s = (m - 1.0) / (m + 1.0), z = s * s;
        Real sum = z * 0.19235933878519507 + 0.22195308321368660;
        sum = z * sum + 0.26230818925253882;
        sum = z * sum + 0.32059889797532520;
        sum = z * sum + 0.41219858311113240;
        sum = z * sum + 0.57707801635558535;
        sum = z * sum + 0.96179669392597560;
        sum = z * sum + 2.8853900817779268;
        const Real power = y * (s * sum + e);
        const Real shifted = power + to_integer;
        const Real f = (power - (shifted - to_integer)) * 0.69314718055994531;
        Real value = f * 2.5052108385441720e-8 + 2.7557319223985893e-7;
        value = f * value + 2.7557319223985893e-6;
        value = f * value + 2.4801587301587302e-5;
        value = f * value + 1.9841269841269841e-4;
        value = f * value + 1.3888888888888889e-3;
        value = f * value + 8.3333333333333333e-3;
        value = f * value + 4.1666666666666667e-2;
        value = f * value + 1.6666666666666667e-1;
        value = f * value + 0.5;
        value = f * value + 1.0;
        value = f * value + 1.0;
        return cast<Real>(Integer(cast<Integer>(value) + (cast<Integer>(shifted) << 52)));
    }

  private:
    template <class To, class From>
    [[gnu::always_inline]] static inline To cast(const From& from) noexcept
    {
        To to;
        std::memcpy(&to, &from, sizeof to);
        return to;
    }
};

/// x^y.
template <class Real>
[[nodiscard]] Real step_power(const Real& x, const Real& y) noexcept
{
    if constexpr (std::is_same_v<Real, double> || std::is_same_v<Real, float>) {
        return static_cast<Real>(PowerLanes<1>::power(static_cast<double>(x), static_cast<double>(y)));
    } else {
        using std::pow;
        return Real(pow(x, y));
    }
}
template <class T, int N>
[[nodiscard]] Pack<T, N> step_power(const Pack<T, N>& x, const Pack<T, N>& y) noexcept
{
    using Reals = typename VectorOf<double, N>::type;
    const Reals power =
        PowerLanes<N>::power(__builtin_convertvector(x.lanes, Reals), __builtin_convertvector(y.lanes, Reals));
    return Pack<T, N>::of(__builtin_convertvector(power, typename Pack<T, N>::Vector));
}

} // namespace lagen::detail
