// SPDX-License-Identifier: GPL-2.0-or-later
/// Philox4x32-10: random numbers made from a counter and a key alone, so that any of them can be had without those
/// before it. Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel Random Numbers: As Easy as 1, 2, 3,
/// SC '11.
#pragma once

#include <array>
#include <cstdint>

namespace lagen {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

/// The four words that belong to `counter` under `key`.
[[nodiscard]] constexpr PhiloxCounter philox(PhiloxCounter counter, PhiloxKey key)
{
    constexpr std::uint64_t first = 0xD2511F53U, second = 0xCD9E8D57U;
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = first * counter[0], b = second * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32U) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32U) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
        key[0] += 0x9E3779B9U;
        key[1] += 0xBB67AE85U;
    }
    return counter;
}

/// A number of [0, 1) with 53 bits: that of axis `axis` in row `row`.
[[nodiscard]] constexpr double uniform_number(std::uint64_t seed, std::uint64_t row, std::uint32_t axis)
{
    const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32U); };
    const PhiloxCounter words = philox({low(row), high(row), axis, 0}, {low(seed), high(seed)});
    const std::uint64_t bits = (std::uint64_t{words[0]} << 32U | words[1]) >> 11U;
    return static_cast<double>(bits) * 0x1p-53;
}

} // namespace lagen
