// SPDX-License-Identifier: MIT
/// Sine and cosine of one angle, or of all angles of a kernel at once:
///   const auto [sine, cosine] = sincos(x);
///   const auto [sines, cosines] = sincos<S, 3>({a, b, c});
/// float and double are computed here, two to eight angles to a vector instruction where the compiler has vectors
/// (g++, clang); an angle gets the same bits alone and among others. Every other scalar calls its own sin and cos.
///
/// double: x = n pi/2 + hi + lo by Cody and Waite's reduction with pi/2 in three parts, then the polynomials of fdlibm
/// (k_sin.c, k_cos.c: Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunSoft, a Sun
/// Microsystems, Inc. business. Permission to use, copy, modify, and distribute this software is freely granted,
/// provided that this notice is preserved.) The error is below 0.87 ulp; beyond 2^17 the angle goes to std::sin and
/// std::cos. float: the same in double with shorter polynomials, below 0.54 ulp; where the processor has no doubles, in
/// whole numbers, as exact.
#pragma once

#include "lagen/requirements.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

// True where each operation of a double is a call, as on a Cortex-M4F.
#if (defined(__arm__) && !(defined(__ARM_FP) && (__ARM_FP & 8))) || defined(__xtensa__) ||                             \
    (defined(__riscv) && !(defined(__riscv_flen) && __riscv_flen >= 64))
#define LAGEN_DOUBLES_ARE_CALLS
#include "lagen/single_sincos.hpp"
#endif

namespace lagen {

/// Sine and cosine of one angle.
template <class S>
struct SineCosine {
    S sine;
    S cosine;
};

/// Sines and cosines of K angles, in their order.
template <class S, std::size_t K>
struct SinesCosines {
    std::array<S, K> sines;
    std::array<S, K> cosines;
};

#if defined(__GNUC__)

namespace detail {

/// W doubles and W integers of their size.
template <std::size_t W>
struct Lanes {
    typedef double Real __attribute__((vector_size(8 * W)));
    typedef std::int64_t Integer __attribute__((vector_size(8 * W)));
};

/// How many doubles a vector register of the target holds.
#if defined(__AVX512F__)
inline constexpr std::size_t widest_lanes = 8;
#elif defined(__AVX__)
inline constexpr std::size_t widest_lanes = 4;
#else
inline constexpr std::size_t widest_lanes = 2;
#endif

/// n pi/2 is subtracted exactly up to here: n has at most 17 bits, the first two parts of pi/2 have 33 each.
inline constexpr double largest_reduced_angle = 0x1p17;

/// No sum below has two products, so that a compiler that contracts a b + c has one way to do it, the same for every
/// number of lanes.
template <std::size_t W>
struct SinCosLanes {
    using Real = typename Lanes<W>::Real;
    using Integer = typename Lanes<W>::Integer;

    /// |x|, a lane.
    [[gnu::always_inline]] static inline Real size_of(const Real& x) noexcept
    {
        return std::bit_cast<Real>(std::bit_cast<Integer>(x) & (Integer{} + INT64_MAX));
    }

    /// |x| = n pi/2 + hi + lo, |hi| <= pi/4, |lo| < 2^-51; where hi is small lo may be as large as it.
    struct Reduced {
        Integer quadrant; ///< n in its two lowest bits
        Real hi;
        Real lo;
    };

    /// The first products and differences are exact; `lost` is what rounding takes from the second difference.
    [[gnu::always_inline]] static inline Reduced reduce(const Real& size) noexcept
    {
        constexpr double to_integer = 0x1.8p52; // x + this has the nearest integer of x in its lowest bits
        const Real shifted = size * 0x1.45f306dc9c883p-1 + to_integer;
        const Real n = shifted - to_integer;
        const Real first = size - n * 0x1.921fb544p+0;
        const Real second_part = n * 0x1.0b4611a6p-34;
        const Real second = first - second_part;
        const Real lost = (first - second) - second_part;
        return {std::bit_cast<Integer>(shifted), second, lost - n * 0x1.3198a2e037073p-69};
    }

    /// Sines and cosines of the lanes of `x`; lanes beyond largest_reduced_angle, infinite or not a number get numbers
    /// without meaning.
    template <bool single>
    [[gnu::always_inline]] static inline void compute(const Real& x, Real& sines, Real& cosines) noexcept
    {
        const Integer sign = std::bit_cast<Integer>(x) & (Integer{} + INT64_MIN);
        const Reduced angle = reduce(size_of(x));
        const Real z = angle.hi * angle.hi;
        const Real half_z = 0.5 * z;
        const Real sine = single ? single_sine(angle, z) : double_sine(angle, z, half_z);
        const Real cosine = single ? single_cosine(z, half_z) : double_cosine(angle, z, half_z);
        const Integer odd = -(angle.quadrant & 1);
        const Integer sine_bits = std::bit_cast<Integer>(sine);
        const Integer cosine_bits = std::bit_cast<Integer>(cosine);
        const Integer exchange = (sine_bits ^ cosine_bits) & odd;
        const Integer negative = (angle.quadrant & 2) << 62;
        const Integer negative_cosine = ((angle.quadrant + 1) & 2) << 62;
        sines = std::bit_cast<Real>(sine_bits ^ exchange ^ negative ^ sign);
        cosines = std::bit_cast<Real>(cosine_bits ^ exchange ^ negative_cosine);
    }

  private:
    /// sin(hi + lo) = hi + lo (1 - z/2) + hi z (s1 + s2 z + ..), z = hi^2.
    [[gnu::always_inline]] static inline Real double_sine(const Reduced& r, const Real& z, const Real& half_z) noexcept
    {
        const Real zz = z * z;
        const Real tail =
            (8.33333333332248946124e-03 + z * -1.98412698298579493134e-04) +
            zz * ((2.75573137070700676789e-06 + z * -2.50507602534068634195e-08) + zz * 1.58969099521155010221e-10);
        const Real series = -1.66666666666666324348e-01 + z * tail;
        return r.hi + ((r.lo + z * r.hi * series) - r.lo * half_z);
    }

    /// cos(hi + lo) = 1 - z/2 - hi lo + z^2 (c1 + c2 z + ..); what 1 - z/2 loses to rounding is added at the end.
    [[gnu::always_inline]] static inline Real double_cosine(const Reduced& r, const Real& z,
                                                            const Real& half_z) noexcept
    {
        const Real zz = z * z;
        const Real series = (4.16666666666666019037e-02 + z * -1.38888888888741095749e-03) +
                            zz * ((2.48015872894767294178e-05 + z * -2.75573143513906633035e-07) +
                                  zz * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
        const Real main = 1.0 - half_z;
        const Real lost = (1.0 - main) - half_z;
        return main + ((lost + zz * series) - r.hi * r.lo);
    }

    /// Taylor polynomials: at pi/4 the first term left out is 2e-9 of the sine and 2e-9 of the cosine.
    [[gnu::always_inline]] static inline Real single_sine(const Reduced& r, const Real& z) noexcept
    {
        const Real hi = r.hi + r.lo;
        const Real zz = z * z;
        const Real series = (-1.0 / 6 + z * (1.0 / 120)) + zz * (-1.0 / 5040 + z * (1.0 / 362880));
        return hi + z * hi * series;
    }
    [[gnu::always_inline]] static inline Real single_cosine(const Real& z, const Real& half_z) noexcept
    {
        const Real zz = z * z;
        const Real series = (1.0 / 24 + z * (-1.0 / 720)) + zz * (1.0 / 40320 + z * (-1.0 / 3628800));
        return (1.0 - half_z) + zz * series;
    }
};

/// The sum of the lanes, by halves.
template <std::size_t W>
[[gnu::always_inline]] inline double add_lanes(const typename Lanes<W>::Real& v) noexcept
{
    if constexpr (W == 2) {
        return v[0] + v[1];
    } else {
        const auto halves = std::bit_cast<std::array<typename Lanes<W / 2>::Real, 2>>(v);
        return add_lanes<W / 2>(halves[0] + halves[1]);
    }
}

/// Angles k .. k + W - 1 of `x`, lanes beyond the last angle being 0; answers the sum of their sizes.
template <std::size_t W, class T, std::size_t K>
[[gnu::always_inline]] inline double sincos_lanes(const std::array<T, K>& x, std::size_t k,
                                                  SinesCosines<T, K>& result) noexcept
{
    constexpr bool single = std::is_same_v<T, float>;
    const std::size_t count = K - k < W ? K - k : W;
    typename Lanes<W>::Real angles{};
    typename Lanes<W>::Real sines;
    typename Lanes<W>::Real cosines;
    for (std::size_t lane = 0; lane < count; ++lane) angles[lane] = static_cast<double>(x[k + lane]);
    SinCosLanes<W>::template compute<single>(angles, sines, cosines);
    for (std::size_t lane = 0; lane < count; ++lane) {
        result.sines[k + lane] = static_cast<T>(sines[lane]);
        result.cosines[k + lane] = static_cast<T>(cosines[lane]);
    }
    return add_lanes<W>(SinCosLanes<W>::size_of(angles));
}

/// The angles that the reduction does not reach, and those that are not finite.
template <class T, std::size_t K>
[[gnu::noinline, gnu::cold]] void sincos_beyond(const std::array<T, K>& x, SinesCosines<T, K>& result) noexcept
{
    for (std::size_t k = 0; k < K; ++k) {
        if (std::fabs(static_cast<double>(x[k])) <= largest_reduced_angle) continue;
        result.sines[k] = std::sin(x[k]);
        result.cosines[k] = std::cos(x[k]);
    }
}

/// Angles 0 .. sizeof...(part) * widest_lanes - 1, written out: what is in registers stays there.
template <class T, std::size_t K, std::size_t... part>
[[gnu::always_inline]] inline double sincos_full([[maybe_unused]] const std::array<T, K>& x,
                                                 [[maybe_unused]] SinesCosines<T, K>& result,
                                                 std::index_sequence<part...>) noexcept
{
    return (0.0 + ... + sincos_lanes<widest_lanes>(x, part * widest_lanes, result));
}

/// A whole number of full vectors, then the rest in the narrowest that holds it.
template <class T, std::size_t K>
[[gnu::always_inline]] inline SinesCosines<T, K> sincos_vectors(const std::array<T, K>& x) noexcept
{
    SinesCosines<T, K> result;
#if defined(LAGEN_DOUBLES_ARE_CALLS)
    if constexpr (std::is_same_v<T, float>) {
        for (std::size_t k = 0; k < K; ++k) {
            const SingleSinCos both = single_sincos(x[k]);
            result.sines[k] = both.sine;
            result.cosines[k] = both.cosine;
        }
        return result;
    }
#endif
    double size = sincos_full(x, result, std::make_index_sequence<K / widest_lanes>{});
    constexpr std::size_t full = K / widest_lanes * widest_lanes;
    constexpr std::size_t rest = K - full;
    if constexpr (rest > 0 && rest <= 2)
        size += sincos_lanes<2>(x, full, result);
    else if constexpr (rest > 0)
        size += sincos_lanes<(rest <= 4 ? 4 : 8)>(x, full, result);
    if (!(size <= largest_reduced_angle)) [[unlikely]] // one of them may be
        sincos_beyond(x, result);
    return result;
}

} // namespace detail

#endif

/// How sine and cosine of a scalar are computed: by its own sin and cos, unless there is a specialisation.
template <class S>
struct SinCosOf {
    [[nodiscard]] static SineCosine<S> compute(const S& x) noexcept
    {
        using std::cos;
        using std::sin;
        return {S(sin(x)), S(cos(x))};
    }
};

/// Sine and cosine of one angle.
template <class S>
[[nodiscard, gnu::always_inline]] inline SineCosine<S> sincos(const S& x) noexcept
{
#if defined(__GNUC__)
    if constexpr (std::is_same_v<S, double> || std::is_same_v<S, float>) {
        const auto [sines, cosines] = detail::sincos_vectors(std::array<S, 1>{x});
        return {sines[0], cosines[0]};
    }
#endif
    return SinCosOf<S>::compute(x);
}

/// The sines and cosines of K angles.
template <class S, std::size_t K>
[[nodiscard, gnu::always_inline]] inline SinesCosines<S, K> sincos(const std::array<S, K>& x) noexcept
{
#if defined(__GNUC__)
    if constexpr (K > 0 && (std::is_same_v<S, double> || std::is_same_v<S, float>)) return detail::sincos_vectors(x);
#endif
    SinesCosines<S, K> result;
    for (std::size_t k = 0; k < K; ++k) {
        const SineCosine<S> both = sincos<S>(x[k]);
        result.sines[k] = both.sine;
        result.cosines[k] = both.cosine;
    }
    return result;
}

} // namespace lagen
