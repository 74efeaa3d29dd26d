// SPDX-License-Identifier: GPL-2.0-or-later
#include "expression/special_angles.hpp"

#include <array>
#include <utility>

namespace lagen {

namespace {

/// Turns of the first quadrant, and the squares of their sines.
const std::array<std::pair<Rational, Rational>, 5>& quadrant()
{
    static const std::array<std::pair<Rational, Rational>, 5> table{{{0, 0},
                                                                     {Rational(1, 6), Rational(1, 4)},
                                                                     {Rational(1, 4), Rational(1, 2)},
                                                                     {Rational(1, 3), Rational(3, 4)},
                                                                     {Rational(1, 2), 1}}};
    return table;
}

} // namespace

std::optional<Rational> rational_root(const Rational& value)
{
    const mpz_class &p = value.get_num(), &q = value.get_den();
    if (sgn(p) < 0 || mpz_perfect_square_p(p.get_mpz_t()) == 0 || mpz_perfect_square_p(q.get_mpz_t()) == 0)
        return std::nullopt;
    return Rational(sqrt(p), sqrt(q));
}

std::optional<SignedRoot> sine_of_turn(const Rational& turn)
{
    mpz_class half_turns;
    mpz_fdiv_q(half_turns.get_mpz_t(), turn.get_num_mpz_t(), turn.get_den_mpz_t());
    Rational rest = turn - half_turns; // sin(rest pi) >= 0
    if (rest > Rational(1, 2)) rest = 1 - rest;
    const int sign = mpz_odd_p(half_turns.get_mpz_t()) != 0 ? -1 : 1;
    for (const auto& [angle, square] : quadrant())
        if (angle == rest) return SignedRoot{sgn(square) * sign, square};
    return std::nullopt;
}

std::optional<SignedRoot> cosine_of_turn(const Rational& turn)
{
    return sine_of_turn(turn + Rational(1, 2));
}

std::optional<SignedRoot> tangent_of_turn(const Rational& turn)
{
    const std::optional<SignedRoot> sine = sine_of_turn(turn), cosine = cosine_of_turn(turn);
    if (!sine || !cosine || cosine->sign == 0) return std::nullopt;
    return SignedRoot{sine->sign * cosine->sign, sine->square / cosine->square};
}

std::optional<Rational> turn_of_sine(const SignedRoot& a)
{
    for (const auto& [angle, square] : quadrant())
        if (square == a.square) return Rational(a.sign * angle);
    return std::nullopt;
}

std::optional<Rational> turn_of_tangent(const SignedRoot& a)
{
    return turn_of_sine({a.sign, a.square / (1 + a.square)});
}

} // namespace lagen
