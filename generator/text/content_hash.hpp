// SPDX-License-Identifier: GPL-2.0-or-later
/// Names made from content: FNV-1a over the bytes, 64 bits twice with different bases where 128 are wanted.
/// It tells accidental differences apart (model hash in a banner, key of the compile cache); it is no protection
/// against somebody who wants a collision. Source: http://www.isthe.com/chongo/tech/comp/fnv/
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lagen {

class ContentHash {
  public:
    /// Adds a piece; pieces are separated, so ("ab", "c") differs from ("a", "bc").
    ContentHash& add(std::string_view bytes)
    {
        for (const char byte : bytes) mix(static_cast<unsigned char>(byte));
        for (std::uint64_t length = bytes.size(), k = 0; k < 8; ++k, length >>= 8U) mix(length & 0xffU);
        return *this;
    }

    [[nodiscard]] std::string hex16() const { return hex(low_); }
    [[nodiscard]] std::string hex32() const { return hex(high_) + hex(low_); }

  private:
    void mix(std::uint64_t byte)
    {
        low_ = (low_ ^ byte) * prime;
        high_ = (high_ ^ byte ^ 0x5bU) * prime;
    }
    static std::string hex(std::uint64_t value)
    {
        std::string digits(16, '0');
        for (std::size_t k = 16; k-- > 0; value >>= 4U) digits[k] = "0123456789abcdef"[value & 0xfU];
        return digits;
    }

    static constexpr std::uint64_t prime = 1099511628211ULL;
    std::uint64_t low_ = 14695981039346656037ULL;
    std::uint64_t high_ = 0x9ae16a3b2f90404fULL;
};

} // namespace lagen
