// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact numbers and free texts as C++: literals that are right in every scalar, comments that cannot break out.
#pragma once

#include "expression/tree.hpp"

namespace lagen {

/// A piece of an expression and how tightly it binds.
struct Spelling {
    std::string text;
    int precedence = 5; ///< 0 comparison, 1 sum and sign, 2 product and quotient, 5 closed
};

/// Rounded to nearest; mpq_get_d would truncate.
[[nodiscard]] double nearest_double(const Rational& value);

/// S(2), S(0.5), S(1) / S(10): the nearest value in float, double, long double and wider types alike. Where numerator
/// or denominator needs more than 53 bits: the sum of two doubles (107 bits).
[[nodiscard]] Spelling print_literal(const Rational& value);

/// pi to 107 bits as the sum of two doubles.
[[nodiscard]] Spelling print_pi();

/// One line of text that may stand in a // comment: control characters become spaces, a backslash becomes '/', "??"
/// and "*/" are pulled apart.
[[nodiscard]] std::string plain_text(std::string_view text);

/// The same of a user's description, cut at 200 bytes.
[[nodiscard]] std::string comment_text(std::string_view text);

/// The text as a C++ string literal with its quotes.
[[nodiscard]] std::string string_literal(std::string_view text);

} // namespace lagen
