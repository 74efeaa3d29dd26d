// SPDX-License-Identifier: GPL-2.0-or-later
/// One operation on closed scalars, vectors and matrices.
#pragma once

#include "expression/closed.hpp"

namespace lagen {

/// The value of `tree`, an operation (no name, application or repetition), from those of its arguments, same order.
/// Throws ModelError: shapes that do not fit, an index that is no integer or out of range, a bound exceeded.
[[nodiscard]] Value combine(const Maker& maker, const Tree& tree, std::vector<Value> arguments);

/// A value of unknown shape, in a function's body that is checked on its own.
[[nodiscard]] Value open_value(const SourceRange& where);

/// "a vector of 3" with its place, for a message about an argument.
[[noreturn]] void refuse(const Tree& argument, const std::string& message, const std::string& hint);

/// The sum of values of the same shape; `where_of[k]` is the term that value k came from.
[[nodiscard]] Value add_values(const Maker& maker, std::span<const Value> terms, std::span<const Tree> where_of);
[[nodiscard]] Value multiply_values(const Maker& maker, std::span<const Value> factors);
[[nodiscard]] Value power_of_matrix(const Maker& maker, const Tree& tree, const Value& base, const Value& exponent);

/// [a, b], [[a, b], [c, d]].
[[nodiscard]] Value join_entries(const Maker& maker, const Tree& tree, std::span<const Value> entries);
/// x[i], W[i,j], and of ranges x[2..n], W[i,:], W[1..2,1..2]: a range keeps its dimension, an index drops it.
[[nodiscard]] Value pick_entry(const Maker& maker, const Tree& tree, std::span<const Value> arguments);
/// A range, which `pick_entry` takes for an index.
[[nodiscard]] Value close_range(const Tree& tree, std::span<const Value> ends);

/// A built-in function with a vector or matrix among its arguments or for its value.
[[nodiscard]] Value call_on_arrays(const Maker& maker, const Tree& tree, std::span<const Value> arguments);

// [[..],[..]] of a matrix function. Each takes the node that asks, for its place.
[[nodiscard]] Value inverse_matrix(const Maker& maker, const Tree& tree, const Value& a);
[[nodiscard]] Value identity_matrix(const Maker& maker, std::size_t n);
/// det A by minors along rows; a minor is made once for each set of columns. n <= 8.
[[nodiscard]] Value determinant(const Maker& maker, const Tree& tree, const Value& a);

/// hat(v) w = v x w; of a scalar s, [[0, -s], [s, 0]].
[[nodiscard]] Value hat(const Maker& maker, const Tree& tree, const Value& v);
/// The v of a skew matrix hat(v). Throws ModelError where the entries are not each other's negatives as written.
[[nodiscard]] Value vee(const Maker& maker, const Tree& tree, const Value& a);
/// exp A of a skew matrix: 1 + c_1(z) v^ + c_2(z) v^ v^, z = |v|^2; of 2 x 2, cos and sin.
[[nodiscard]] Value exponential(const Maker& maker, const Tree& tree, const Value& a);
/// (1 - A/2)^-1 (1 + A/2); of a skew 3 x 3 matrix 1 + (v^ + v^ v^/2)/(1 + |v|^2/4).
[[nodiscard]] Value cayley(const Maker& maker, const Tree& tree, const Value& a);

} // namespace lagen
