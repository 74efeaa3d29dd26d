// SPDX-License-Identifier: GPL-2.0-or-later
/// Vectors and matrices of closed trees, and the names of the entries of a family.
/// After closing, everything is scalar: the entry of a family is a symbol of its own, "x[3]" or "W[1,2]".
#pragma once

#include "expression/tree.hpp"

namespace lagen {

enum class Rank { scalar, vector, matrix };

/// A vector has `rows` entries and one column; a scalar is 1 x 1.
struct Shape {
    Rank rank = Rank::scalar;
    std::size_t rows = 1, columns = 1;

    [[nodiscard]] std::size_t size() const { return rows * columns; }
    friend bool operator==(const Shape&, const Shape&) = default;
};

/// "a scalar", "a vector of 3", "a 2 x 3 matrix".
[[nodiscard]] std::string to_text(const Shape& shape);

/// Closed scalar trees by rows.
struct ArrayValue {
    Shape shape;
    std::vector<Tree> entries; ///< shape.size() of them
};

/// Vectors, matrices and families have no more entries than this, and no more rows or columns.
inline constexpr std::size_t most_array_entries = 4096;
[[nodiscard]] bool is_too_large(const Shape& shape);

/// "x[3]", "W[1,2]": the entry number k (from 0, by rows) of the family `name`. A scalar's is the name itself.
[[nodiscard]] std::string entry_name(const std::string& name, const Shape& shape, std::size_t k);

/// The name of entry k of the value of an expression: x[1] of "x", (2*x)[1] of "2*x"; a scalar by its text.
[[nodiscard]] std::string value_name(const std::string& text, const Shape& shape, std::size_t k);

} // namespace lagen
