// SPDX-License-Identifier: GPL-2.0-or-later
/// Ring elements as texts of the expression language: terms in the order of the ring, leading sign, over the
/// denominator.
#pragma once

#include "proof/ring.hpp"

namespace lagen::proof {

/// At most `limit` bytes (100 at least); a longer sum is cut after a whole term, or in its first term ("..."), and ends
/// with "... (123 terms)".
[[nodiscard]] std::string to_text(const Ring& ring, const Fraction& a, std::size_t limit = 400);
[[nodiscard]] std::string to_text(const Ring& ring, const Polynomial& p, std::size_t limit = 400);
/// False where `text` was cut, or names an element that has no name in the language, such as an unknown of a linear
/// system: other elements may have the same text, and it must not be read back.
[[nodiscard]] bool is_whole(const std::string& text);

} // namespace lagen::proof
