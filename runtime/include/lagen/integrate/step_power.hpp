// SPDX-License-Identifier: MIT
/// Powers of numbers x >= +0, of which lengths of steps are made: within 1.2e-4 x^y of x^y, |y| <= 1, so long as that
/// is a normal number, and growing with x but for its last two bits. Of float and double, the bits do not depend on the
/// library, nor on whether a number is alone or a lane of a pack, nor, without fused multiplication, on the machine;
/// other scalars call their own pow.
#pragma once

#include "lagen/lanes/pack.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace lagen::detail {

/// Whole numbers of the size of doubles, a lane.
template <class Real>
struct IntegersOf {
    using type = std::int64_t;
};
template <int N>
struct IntegersOf<Pack<double, N>> {
    using type = typename Mask<double, N>::Vector;
};

/// Of double and packs of it. No sum has two products, so that a compiler that contracts has one way to do it.
template <class Real>
struct StepPower {
    using Integer = typename IntegersOf<Real>::type;
    static constexpr double to_integer = 0x1.8p52; ///< its lowest bits are those of a whole number that is added

    /// x = 2^e m with m within sqrt(1/2) .. sqrt(2); log2 x = e + 2/ln 2 artanh((m - 1)/(m + 1)), whose series ends
    /// with an error of 9e-5. Of 0: -1023.
    [[nodiscard]] [[gnu::always_inline]] static inline Real logarithm(const Real& x) noexcept
    {
        Integer bits;
        std::memcpy(&bits, &x, sizeof bits);
        const Integer exponent = (bits - 0x3fe6a09e667f3bcd) >> 52;
        const Integer whole = exponent + std::bit_cast<std::int64_t>(to_integer), part = bits - (exponent << 52);
        Real e, m;
        std::memcpy(&e, &whole, sizeof e);
        std::memcpy(&m, &part, sizeof m);
        const Real s = (m - 1.0) / (m + 1.0), z = s * s;
        return s * (z * 0.96179669392597560 + 2.8853900817779268) + (e - to_integer);
    }

    /// 2^z = 2^n 2^f, |f| <= 1/2, whose series ends with a relative error of 6e-5. What is left out of both series is
    /// larger at their upper ends than at their lower ones, so that they grow from piece to piece.
    [[nodiscard]] [[gnu::always_inline]] static inline Real exponential(const Real& z) noexcept
    {
        const Real shifted = z + to_integer;
        const Real f = z - (shifted - to_integer), square = f * f;
        const Real low = f * 0.69314718055994531 + 1.0;
        const Real middle = f * 0.055504108664821580 + 0.24022650695910071;
        Real value = square * (square * 0.0096181291076284772 + middle) + low;
        Integer bits, whole;
        std::memcpy(&bits, &value, sizeof bits);
        std::memcpy(&whole, &shifted, sizeof whole);
        bits += whole << 52;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
};

/// log2 x, and 2^x, of float and double and packs of them.
template <class Real>
struct StepPowerOf {
    static constexpr bool is_own = std::is_same_v<Real, double> || std::is_same_v<Real, float>;
    using Power = StepPower<double>;
    [[nodiscard]] static double widened(const Real& x) noexcept { return static_cast<double>(x); }
    [[nodiscard]] static Real narrowed(double x) noexcept { return static_cast<Real>(x); }
};
template <class T, int N>
struct StepPowerOf<Pack<T, N>> {
    static constexpr bool is_own = true;
    using Wide = Pack<double, N>;
    using Power = StepPower<Wide>;
    [[nodiscard]] static Wide widened(const Pack<T, N>& x) noexcept
    {
        return Wide::of(__builtin_convertvector(x.lanes, typename Wide::Vector));
    }
    [[nodiscard]] static Pack<T, N> narrowed(const Wide& x) noexcept
    {
        return Pack<T, N>::of(__builtin_convertvector(x.lanes, typename Pack<T, N>::Vector));
    }
};

/// x^y.
template <class Real>
[[nodiscard]] Real step_power(const Real& x, const Real& y) noexcept
{
    if constexpr (StepPowerOf<Real>::is_own) {
        using Of = StepPowerOf<Real>;
        return Of::narrowed(Of::Power::exponential(Of::widened(y) * Of::Power::logarithm(Of::widened(x))));
    } else {
        using std::pow;
        return Real(pow(x, y));
    }
}

/// x^y and max(x, 1e-4)^z, by one logarithm.
template <class Real>
struct TwoPowers {
    Real of_all, of_large;

    TwoPowers(const Real& x, const Real& y, const Real& z) noexcept
    {
        if constexpr (StepPowerOf<Real>::is_own) {
            using Of = StepPowerOf<Real>;
            const auto logarithm = Of::Power::logarithm(Of::widened(x));
            const std::decay_t<decltype(logarithm)> least(-13.287712379549449);
            of_all = Of::narrowed(Of::Power::exponential(Of::widened(y) * logarithm));
            of_large =
                Of::narrowed(Of::Power::exponential(Of::widened(z) * select(logarithm < least, least, logarithm)));
        } else {
            const Real least = Real(1e-4);
            of_all = step_power(x, y);
            of_large = step_power(x < least ? least : x, z);
        }
    }
};

} // namespace lagen::detail
