// SPDX-License-Identifier: GPL-2.0-or-later
/// Ring elements as texts and trees of the expression language: terms in the order of the ring, leading sign, over the
/// denominator.
#pragma once

#include "proof/ring.hpp"

namespace lagen::proof {

/// At most `limit` bytes (100 at least); a longer sum is cut after a whole term, or in its first term ("..."), and ends
/// with "... (123 terms)".
[[nodiscard]] std::string to_text(const Ring& ring, const Fraction& a, std::size_t limit = 400);
[[nodiscard]] std::string to_text(const Ring& ring, const Polynomial& p, std::size_t limit = 400);
/// The element as a tree; null where a generator has none.
[[nodiscard]] Tree to_tree(const Ring& ring, const Fraction& a);

/// A text, and the tree of it where the text is whole.
struct Printed {
    std::string text;
    Tree tree;
};
[[nodiscard]] Printed print(const Ring& ring, const Fraction& a, std::size_t limit = 400);
[[nodiscard]] Printed print(const Ring& ring, const Polynomial& p, std::size_t limit = 400);
/// function(arguments); null where an argument is.
[[nodiscard]] Tree call_of(Function function, std::vector<Tree> arguments);
/// The same by name; null for what is no function of the language, or has another number of arguments.
[[nodiscard]] Tree call_of(const std::string& function, std::vector<Tree> arguments);

/// False where `text` was cut, or names an element that has no name in the language, such as an unknown of a linear
/// system: other elements may have the same text, and it must not be read back.
[[nodiscard]] bool is_whole(const std::string& text);

} // namespace lagen::proof
