// SPDX-License-Identifier: GPL-2.0-or-later
/// Expressions of families: the indices of their names in order, and what is left of an expression without them. Sums
/// over an index stand in written equations as TreeKind::sum_over with the arguments from, to, body and perhaps the
/// value that is left out; bounds are names whose text is an index.
#pragma once

#include "expression/tree.hpp"

#include <optional>

namespace lagen {

/// The value of an index whose text is a number. Else it is a letter, perhaps with an offset, "j+1"; the greater
/// one of two, "max(i,j)"; or ":", a row.
[[nodiscard]] std::optional<long> index_number(const std::string& text);

/// The text where `letter` is a number, or another letter with or without an offset: "j+1" at j = 2 is "3" and at j = i
/// "i+1", "max(j,5)" at 2 is "5".
[[nodiscard]] std::string index_at(const std::string& text, const std::string& letter, const std::string& value);

/// "j", "j+1", "j-2"; of a number its sum with the offset.
[[nodiscard]] std::string with_offset(const std::string& text, long offset);

struct IndexSlot {
    std::string text;
    std::size_t place = 0; ///< 1: the first index of a name, 2: its second; 0: a bound of a sum

    friend bool operator==(const IndexSlot&, const IndexSlot&) = default;
};

struct IndexShape {
    std::string form; ///< the expression without indices; empty: it is too large to be looked at
    std::vector<IndexSlot> slots;
};
[[nodiscard]] IndexShape shape_of(const Tree& tree);

/// The expression with other texts at its slots, in their order.
[[nodiscard]] Tree with_indices(const Tree& tree, const std::vector<std::string>& texts);

/// The expression at a value of a letter.
[[nodiscard]] Tree at_index(const Tree& tree, const std::string& letter, const std::string& value);
[[nodiscard]] Tree at_index(const Tree& tree, const std::string& letter, long value);

/// A sum of written equations; no `excluded`: every value counts.
struct IndexedSum {
    std::string letter, from, to;
    std::optional<std::string> excluded;
    Tree body;
};
[[nodiscard]] Tree tree_of(const IndexedSum& sum);
[[nodiscard]] IndexedSum indexed_sum(const Tree& tree);

/// The terms of a sum, one behind the other; nothing where its bounds do not say how many there are.
[[nodiscard]] std::optional<std::vector<Tree>> terms_of(const IndexedSum& sum);

/// Sums whose bounds are numbers written out, at any depth.
[[nodiscard]] Tree without_sums(const Tree& tree);

[[nodiscard]] bool has_sums(const Tree& tree);
/// The most sums of which each stands inside of the next.
[[nodiscard]] std::size_t sums_inside(const Tree& tree);

// Guesses of what expressions are with a letter for an index. A guess is to be tried: its values at numbers compared.

struct IndexPattern {
    Tree tree;
    std::string letter;
    long value = 0; ///< of the letter in the expression that the guess was made from
};

/// The pattern of two expressions, with a letter for the indices in which they differ, all by the same number; nothing
/// where they differ otherwise. The letter stands without an offset for the first of them in a name.
[[nodiscard]] std::optional<IndexPattern> common_pattern(const Tree& a, const IndexShape& shape_of_a,
                                                         const IndexShape& shape_of_b, const std::string& letter);

/// Guesses from a single expression: a letter for all indices of names that have this value in one place (0: in any),
/// and for bounds of sums, which it may move or, as max(letter, ..), stop. One at least.
[[nodiscard]] std::vector<Tree> lifted(const Tree& tree, const std::string& letter, long value, std::size_t place);

/// Such guesses for each value and place.
[[nodiscard]] std::vector<IndexPattern> lifted_patterns(const Tree& tree, const std::string& letter);

} // namespace lagen
