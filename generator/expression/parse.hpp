// SPDX-License-Identifier: GPL-2.0-or-later
/// Text to tree: a Pratt parser for the expression language (README, "Expressions").
/// Precedence, loosest first: comparison, + -, * /, unary minus, ^ (right associative; its exponent may carry a sign).
#pragma once

#include "expression/tree.hpp"

#include <limits>

namespace lagen {

/// The bounds of what one expression costs. Every bound is named in the error that it causes.
struct ParseLimits {
    std::size_t depth = 256;        ///< nested parentheses, calls, signs, exponents
    std::size_t length = 1'000'000; ///< bytes of text
    std::size_t digits = 400;       ///< digits of one literal
    long decimal_exponent = 400;    ///< |e| in 1.5e-300
    long exponent = 64;             ///< |n| of a constant integer exponent of a non-constant base
    std::size_t number_bits = 4096; ///< numerator and denominator of a constant
    long degree = 4096;             ///< total degree of nested powers: ((x^64)^64)^64 has degree 262144
    long product_degree =
        std::numeric_limits<long>::max(); ///< of products and quotients; of a text its length bounds it
    std::size_t height = 1024;            ///< operations inside one another; a/b/c/d counts 3
};

/// Parses one expression. Decimals become exact rationals (0.1 is 1/10); constant sub-expressions of numbers are
/// folded only as far as needed to check the bounds (the tree keeps what was written).
/// Throws ModelError: unexpected character or end, unbalanced parenthesis, missing operator ("2 x"), wrong arity of a
/// built-in function, a bound exceeded, invalid UTF-8, a division by the literal zero.
[[nodiscard]] Tree parse_expression(const Excerpt& text, const ParseLimits& limits = {});

/// Parses a comparison `a < b` (strict or not), as domains and if() use it. A chain a < b < c is refused with a hint.
[[nodiscard]] Tree parse_comparison(const Excerpt& text, const ParseLimits& limits = {});

/// True for ASCII or Unicode letters, digits and '_', not starting with a digit, valid UTF-8.
[[nodiscard]] bool is_identifier(std::string_view text);

} // namespace lagen
