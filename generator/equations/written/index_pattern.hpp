// SPDX-License-Identifier: GPL-2.0-or-later
/// Guesses of what expressions are with a letter for an index. A guess is to be tried: its values at numbers compared.
#pragma once

#include "equations/written/index_shape.hpp"

namespace lagen {

struct IndexPattern {
    Tree tree;
    std::string letter;
    long value = 0; ///< of the letter in the expression that the guess was made from
};

/// What two expressions are with a letter for the indices in which they differ, all by the same number; nothing where
/// they differ otherwise. The letter stands without an offset for the first of them in a name.
[[nodiscard]] std::optional<IndexPattern> common_pattern(const Tree& a, const IndexShape& shape_of_a,
                                                         const IndexShape& shape_of_b, const std::string& letter);

/// Guesses from a single expression: a letter for all indices of names that have this value in one place (0: in any),
/// and for bounds of sums, which it may move or, as max(letter, ..), stop. One at least.
[[nodiscard]] std::vector<Tree> lifted(const Tree& tree, const std::string& letter, long value, std::size_t place);

/// Such guesses for each value and place.
[[nodiscard]] std::vector<IndexPattern> lifted_patterns(const Tree& tree, const std::string& letter);

} // namespace lagen
