// SPDX-License-Identifier: GPL-2.0-or-later
/// Bytes read as a series of choices: whatever the bytes are, they say something.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lagen::fuzz {

class Choices {
  public:
    explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    /// One of 0 .. count - 1; 0 when the bytes are used up.
    std::size_t below(std::size_t count)
    {
        if (next_ == bytes_.size()) return 0;
        return bytes_[next_++] % count;
    }
    [[nodiscard]] bool used_up() const { return next_ == bytes_.size(); }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
};

} // namespace lagen::fuzz
