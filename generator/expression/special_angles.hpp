// SPDX-License-Identifier: GPL-2.0-or-later
/// The angles whose sine is a square root of a rational number, as multiples of pi: those of 30 and 45 degrees.
#pragma once

#include "expression/tree.hpp"

#include <optional>

namespace lagen {

/// sign sqrt(square); sign 0 where square is.
struct SignedRoot {
    int sign = 1;
    Rational square = 1;

    [[nodiscard]] SignedRoot operator*(const SignedRoot& b) const { return {sign * b.sign, square * b.square}; }
};

[[nodiscard]] inline SignedRoot signed_root(const Rational& value)
{
    return {sgn(value), value * value};
}

/// sqrt(value) of a value that is not negative, where it is rational.
[[nodiscard]] std::optional<Rational> rational_root(const Rational& value);

/// sin(turn pi), cos(turn pi), tan(turn pi); nothing where it is no such number, or has no value.
[[nodiscard]] std::optional<SignedRoot> sine_of_turn(const Rational& turn);
[[nodiscard]] std::optional<SignedRoot> cosine_of_turn(const Rational& turn);
[[nodiscard]] std::optional<SignedRoot> tangent_of_turn(const Rational& turn);

/// sin, cos or tan of a multiple of pi that is written as one, where it is rational; nothing of other calls.
[[nodiscard]] std::optional<Rational> value_at_turn(Function function, const Tree& argument);

/// asin(a)/pi and atan(a)/pi, where they are such turns.
[[nodiscard]] std::optional<Rational> turn_of_sine(const SignedRoot& a);
[[nodiscard]] std::optional<Rational> turn_of_tangent(const SignedRoot& a);

} // namespace lagen
