// SPDX-License-Identifier: GPL-2.0-or-later
/// Seeded random numbers, the same with every standard library.
#pragma once

#include <gmpxx.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lagen::testing {

/// A linear congruential generator modulo 2^64 whose upper bits are used.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed * 2862933555777941757ULL + 3037000493ULL) {}

    /// 0 .. n - 1
    std::size_t below(std::size_t n)
    {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::size_t>((state_ >> 33) % n);
    }
    bool flip() { return below(2) == 0; }
    /// -n .. n without 0
    int signed_digit(int n)
    {
        const int value = static_cast<int>(below(static_cast<std::size_t>(n))) + 1;
        return flip() ? value : -value;
    }
    /// A rational of (-4, 4) with a denominator of 7 to 97; hardly ever a special value.
    mpq_class rational()
    {
        const auto denominator = static_cast<long>(below(91)) + 7;
        const long numerator =
            static_cast<long>(below(static_cast<std::size_t>(8 * denominator - 1))) - 4 * denominator + 1;
        mpq_class value(numerator, denominator);
        value.canonicalize();
        return value;
    }
    template <class Item>
    const Item& pick(const std::vector<Item>& items)
    {
        return items[below(items.size())];
    }

  private:
    std::uint64_t state_;
};

} // namespace lagen::testing
