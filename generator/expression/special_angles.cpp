// SPDX-License-Identifier: GPL-2.0-or-later
#include "expression/special_angles.hpp"

#include <array>
#include <utility>
#include <vector>

namespace lagen {

namespace {

constexpr int deepest_angle = 12; ///< trees are shared, and this walk does not remember them

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

/// rest + turn pi.
struct Angle {
    Rational turn = 0, rest = 0;
};

std::optional<Angle> angle_of(const TreeNode& node, int depth = deepest_angle)
{
    if (depth == 0) return std::nullopt;
    std::vector<Angle> of;
    for (const Tree& argument : node.arguments) {
        const auto angle = angle_of(*argument, depth - 1);
        if (!angle) return std::nullopt;
        of.push_back(*angle);
    }
    Angle out;
    switch (node.kind) {
    case TreeKind::pi: return Angle{1, 0};
    case TreeKind::number: return Angle{0, node.number};
    case TreeKind::negate: return Angle{-of[0].turn, -of[0].rest};
    case TreeKind::add:
        for (const Angle& term : of) out = {out.turn + term.turn, out.rest + term.rest};
        return out;
    case TreeKind::multiply:
        out.rest = 1;
        for (const Angle& b : of) {
            if (out.turn != 0 && b.turn != 0) return std::nullopt;
            out = {out.turn * b.rest + out.rest * b.turn, out.rest * b.rest};
        }
        return out;
    case TreeKind::divide:
        if (of[1].turn != 0 || of[1].rest == 0) return std::nullopt;
        return Angle{of[0].turn / of[1].rest, of[0].rest / of[1].rest};
    default: return std::nullopt;
    }
}

} // namespace

std::optional<Rational> value_at_turn(Function function, const Tree& argument)
{
    if (function != Function::sin && function != Function::cos && function != Function::tan) return std::nullopt;
    const auto angle = angle_of(*argument);
    if (!angle || angle->rest != 0) return std::nullopt;
    const auto value = function == Function::sin   ? sine_of_turn(angle->turn)
                       : function == Function::cos ? cosine_of_turn(angle->turn)
                                                   : tangent_of_turn(angle->turn);
    const auto size = value ? rational_root(value->square) : std::nullopt;
    return size ? std::optional<Rational>(value->sign * *size) : std::nullopt;
}

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
