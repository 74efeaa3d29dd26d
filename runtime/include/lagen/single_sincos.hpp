// SPDX-License-Identifier: MIT
/// Sine and cosine of a float in whole numbers of 32 bits, for processors on which every operation of a double is a
/// call:
///   const detail::SingleSinCos both = detail::single_sincos(x);
/// The angle modulo a turn is |x| 2/pi, with as many digits of 2/pi as reach behind those of x [Payne-Hanek 1983]; sine
/// and cosine of the rest are Taylor polynomials with 32 bits behind the point. The error is below 0.54 ulp for every
/// float.
#pragma once

#include "lagen/requirements.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace lagen::detail {

struct SingleSinCos {
    float sine;
    float cosine;
};

/// a b / 2^32.
[[nodiscard]] constexpr std::uint32_t high_product(std::uint32_t a, std::uint32_t b) noexcept
{
    return static_cast<std::uint32_t>(std::uint64_t{a} * b >> 32U);
}

/// r = mantissa 2^(exponent - 32), the mantissa from 2^31 on: |r| <= pi/4; the angle is quadrant pi/2 + r, or - r.
struct SingleReduced {
    std::uint32_t mantissa;
    int exponent;
    std::uint32_t quadrant;
    bool negative;
};

/// Of mantissa 2^exponent >= pi/4, the mantissa of 24 bits.
[[nodiscard]] constexpr SingleReduced reduce_single(std::uint32_t mantissa, int exponent) noexcept
{
    // 0 and the digits of 2/pi. A window of 96 begins where a digit times 2^exponent is 2: all before are whole turns.
    constexpr std::array<std::uint32_t, 8> digits{0,           0xa2f9836eU, 0x4e441529U, 0xfc2757d1U,
                                                  0xf534ddc0U, 0xdb629599U, 0x3c439041U, 0xfe5163abU};
    const auto begin = static_cast<std::size_t>(exponent + 30);
    const auto window = [&](std::size_t k) {
        const std::uint64_t both = std::uint64_t{digits[begin / 32 + k]} << 32U | digits[begin / 32 + k + 1];
        return static_cast<std::uint32_t>(both << begin % 32 >> 32U);
    };
    const std::uint64_t product = (std::uint64_t{mantissa * window(0)} << 32U) + std::uint64_t{mantissa} * window(1) +
                                  high_product(mantissa, window(2));
    const std::uint64_t quadrant = (product + (std::uint64_t{1} << 61U)) >> 62U; // the nearest one
    const std::uint64_t rest = product - (quadrant << 62U);
    const bool negative = rest >> 63U != 0;
    std::uint64_t size = negative ? ~rest + 1 : rest; // of quarter turns, times 2^62
    const int shift = std::countl_zero(size);
    size <<= static_cast<unsigned>(shift);
    // The quarter turns times pi/4 2^32: twice that is the angle.
    std::uint64_t angle = (size >> 32U) * 0xc90fdaa2U;
    const int zeros = std::countl_zero(angle);
    angle <<= static_cast<unsigned>(zeros);
    return {static_cast<std::uint32_t>(angle >> 32U), 3 - shift - zeros, static_cast<std::uint32_t>(quadrant & 3U),
            negative};
}

/// Both at pi/4 at most, as positive numbers.
[[nodiscard]] constexpr SingleSinCos single_series(const SingleReduced& r) noexcept
{
    const auto drop = static_cast<unsigned>(-2 * r.exponent);
    const std::uint32_t square = drop > 31 ? 0 : high_product(r.mantissa, r.mantissa) >> drop;
    std::uint32_t sine = 11836; // 1/9!, 1/7!, 1/5!, 1/3! times 2^32
    for (const std::uint32_t next : {852176U, 35791394U, 715827883U}) sine = next - high_product(square, sine);
    const std::uint32_t lost = high_product(r.mantissa, high_product(square, sine));
    std::uint32_t cosine = 1184; // 1/10!, 1/8!, 1/6!, 1/4!, 1/2! times 2^32
    for (const std::uint32_t next : {106522U, 5965232U, 178956971U, 2147483648U})
        cosine = next - high_product(square, cosine);
    const std::uint32_t below_one = high_product(square, cosine);
    const auto scale = std::bit_cast<float>(static_cast<std::uint32_t>(r.exponent - 32 + 127) << 23U);
    return {static_cast<float>(r.mantissa - lost) * scale,
            static_cast<float>(0x80000000U - (below_one + 1) / 2) * 0x1p-31F};
}

/// Sine and cosine; no numbers where x is infinite or no number.
[[nodiscard]] constexpr SingleSinCos single_sincos(float x) noexcept
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const auto power = static_cast<int>(bits >> 23U & 0xffU) - 127; // |x| is from 2^power to 2^(power + 1)
    if (power == 128) return {x - x, x - x};
    if (power < -14) return {x, 1.0F}; // x^3/6 is less than 0.02 ulp
    const std::uint32_t mantissa = (bits & 0x7fffffU) | 0x800000U;
    const bool small = (bits & 0x7fffffffU) <= 0x3f490fdaU; // at most pi/4
    const SingleReduced r =
        small ? SingleReduced{mantissa << 8U, power + 1, 0, false} : reduce_single(mantissa, power - 23);
    const SingleSinCos both = single_series(r);
    const float sine = r.negative ? -both.sine : both.sine;
    const float first = (r.quadrant & 1U) != 0 ? both.cosine : sine;
    const float second = (r.quadrant & 1U) != 0 ? sine : both.cosine;
    const bool flips = ((r.quadrant & 2U) != 0) != (bits >> 31U != 0);
    return {flips ? -first : first, ((r.quadrant + 1) & 2U) != 0 ? -second : second};
}

} // namespace lagen::detail
