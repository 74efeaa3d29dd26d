// SPDX-License-Identifier: GPL-2.0-or-later
/// Elementary matrices of functions, and cofactors.
#include "frames.hpp"

#include <map>

namespace lagen::laws {
namespace {

Frame identity(std::size_t r)
{
    Frame frame{std::vector<Formula>(r * r), std::vector<Formula>(r * r)};
    for (std::size_t a = 0; a < r; ++a) frame.A[a * r + a] = frame.inverse[a * r + a] = 1;
    return frame;
}

Formula monomial(const LocalAlgebroid& algebroid, Dice& dice)
{
    Formula result(dice.signed_digit(3));
    for (std::size_t factor = dice.below(3); factor > 0 && algebroid.n() > 0; --factor)
        result = result * algebroid.coordinate(dice.below(algebroid.n()));
    if (!algebroid.parameters.empty() && dice.below(3) == 0)
        result = result * Formula::variable(dice.pick(algebroid.parameters));
    return result;
}

/// A coordinate, a multiple, or a sum of two: what stands inside sin and exp.
Formula angle(const LocalAlgebroid& algebroid, Dice& dice)
{
    const Formula x = algebroid.coordinate(dice.below(algebroid.n()));
    switch (dice.below(4)) {
    case 0: return Formula(2) * x;
    case 1: return x + algebroid.coordinate(dice.below(algebroid.n()));
    case 2: return Formula(mpq_class(1, 2)) * x;
    default: return x;
    }
}

/// e_a + f e_b
Frame shear(std::size_t r, const Formula& f, Dice& dice)
{
    Frame frame = identity(r);
    const std::size_t a = dice.below(r), b = (a + 1 + dice.below(r - 1)) % r;
    frame.A[a * r + b] = f;
    frame.inverse[a * r + b] = -f;
    return frame;
}

Frame stretch(std::size_t r, const Formula& u, Dice& dice)
{
    Frame frame = identity(r);
    const std::size_t a = dice.below(r);
    const bool up = dice.flip();
    frame.A[a * r + a] = up ? u : power(u, -1);
    frame.inverse[a * r + a] = up ? power(u, -1) : u;
    return frame;
}

/// (c e_a + s e_b, sign s e_a + c e_b) with c^2 - sign s^2 = 1
Frame rotation(std::size_t r, const Formula& c, const Formula& s, int sign, Dice& dice)
{
    Frame frame = identity(r);
    const std::size_t a = dice.below(r), b = (a + 1 + dice.below(r - 1)) % r;
    frame.A[a * r + a] = frame.A[b * r + b] = frame.inverse[a * r + a] = frame.inverse[b * r + b] = c;
    frame.A[a * r + b] = s;
    frame.A[b * r + a] = Formula(sign) * s;
    frame.inverse[a * r + b] = -s;
    frame.inverse[b * r + a] = Formula(-sign) * s;
    return frame;
}

Formula minor_2(const std::vector<Formula>& A, std::size_t r, std::size_t a, std::size_t b)
{
    std::vector<Formula> rest;
    for (std::size_t i = 0; i < r; ++i)
        for (std::size_t j = 0; j < r; ++j)
            if (i != a && j != b) rest.push_back(A[i * r + j]);
    return r == 2 ? rest[0] : rest[0] * rest[3] - rest[1] * rest[2];
}

} // namespace

Formula random_function(const LocalAlgebroid& algebroid, FunctionClass kind, Dice& dice)
{
    if (algebroid.n() == 0) return monomial(algebroid, dice);
    const Formula x = algebroid.coordinate(dice.below(algebroid.n()));
    switch (kind) {
    case FunctionClass::constant: return dice.signed_digit(4);
    case FunctionClass::polynomial: return monomial(algebroid, dice) + monomial(algebroid, dice);
    case FunctionClass::rational: {
        const Formula y = monomial(algebroid, dice);
        return dice.flip() ? monomial(algebroid, dice) / (Formula(1) + power(x, 2))
                           : monomial(algebroid, dice) / (Formula(2) + power(y, 2));
    }
    case FunctionClass::trigonometric: {
        static const std::vector<std::string> functions{"sin", "cos", "sin", "cos", "tan"};
        return Formula(dice.signed_digit(2)) * call(dice.pick(functions), angle(algebroid, dice));
    }
    case FunctionClass::exponential: {
        static const std::vector<std::string> functions{"exp", "sinh", "cosh", "exp", "tanh"};
        return Formula(dice.signed_digit(2)) * call(dice.pick(functions), angle(algebroid, dice));
    }
    case FunctionClass::positive_roots:
        switch (dice.below(4)) {
        case 0: return call("sqrt", x);
        case 1: return call("log", x);
        case 2: return monomial(algebroid, dice) / x;
        default: return call("sqrt", x * algebroid.coordinate(dice.below(algebroid.n())));
        }
    }
    return 1;
}

Frame random_frame(const LocalAlgebroid& algebroid, FunctionClass kind, Dice& dice)
{
    const std::size_t r = algebroid.r();
    const Formula f = random_function(algebroid, kind, dice);
    if (kind == FunctionClass::constant || r == 1) {
        const Formula u = kind == FunctionClass::constant ? Formula(dice.signed_digit(3)) : Formula(1) + power(f, 2);
        return r == 1 || dice.below(4) == 0 ? stretch(r, u, dice) : shear(r, f, dice);
    }
    if (algebroid.n() > 0 && kind == FunctionClass::trigonometric && dice.flip()) {
        const Formula phi = angle(algebroid, dice);
        return rotation(r, call("cos", phi), call("sin", phi), -1, dice);
    }
    if (algebroid.n() > 0 && kind == FunctionClass::exponential && dice.below(3) == 0) {
        const Formula phi = angle(algebroid, dice);
        if (dice.flip()) return stretch(r, call("exp", phi), dice);
        return rotation(r, call("cosh", phi), call("sinh", phi), 1, dice);
    }
    if (algebroid.n() > 0 && kind == FunctionClass::positive_roots && dice.below(3) == 0)
        return stretch(r, call("sqrt", algebroid.coordinate(dice.below(algebroid.n()))), dice);
    if (dice.below(3) == 0) return stretch(r, Formula(1) + power(f, 2), dice);
    return shear(r, f, dice);
}

LocalAlgebroid in_random_frame(const LocalAlgebroid& algebroid, FunctionClass kind, Dice& dice)
{
    if (algebroid.r() == 0) return algebroid;
    LocalAlgebroid result = algebroid;
    const std::size_t count = kind == FunctionClass::constant ? 3 : 1 + dice.below(2);
    for (std::size_t k = 0; k < count; ++k) result = in_frame(result, random_frame(result, kind, dice));
    return result;
}

/// Whether a polynomial of the algebroid's coordinates and parameters vanishes, which its terms need not show: at a
/// point where few others do.
bool vanishes(const Formula& polynomial, const LocalAlgebroid& algebroid)
{
    std::map<std::string, Formula> point;
    const auto place = [&](const std::string& name) {
        mpq_class value(static_cast<int>(41 + 16 * point.size()), static_cast<int>(59 + 6 * point.size()));
        value.canonicalize();
        point.emplace(name, value);
    };
    for (std::size_t i = 0; i < algebroid.n(); ++i) place(algebroid.coordinate(i).text());
    for (const std::string& parameter : algebroid.parameters) place(parameter);
    return substitute(polynomial, point).is_zero();
}

LocalAlgebroid in_full_frame(const LocalAlgebroid& algebroid, Dice& dice)
{
    const std::size_t r = algebroid.r();
    if (r < 2 || r > 3) return in_random_frame(algebroid, FunctionClass::rational, dice);
    Frame frame{std::vector<Formula>(r * r), std::vector<Formula>(r * r)};
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b)
            frame.A[a * r + b] =
                Formula(dice.signed_digit(2)) + (dice.below(3) == 0 ? monomial(algebroid, dice) : Formula(0));
    Formula determinant;
    for (std::size_t b = 0; b < r; ++b)
        determinant = determinant + Formula(b % 2 == 0 ? 1 : -1) * frame.A[b] * minor_2(frame.A, r, 0, b);
    if (vanishes(determinant, algebroid)) return in_random_frame(algebroid, FunctionClass::rational, dice);
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b)
            frame.inverse[b * r + a] = Formula((a + b) % 2 == 0 ? 1 : -1) * minor_2(frame.A, r, a, b) / determinant;
    return in_frame(algebroid, frame);
}

LocalAlgebroid in_random_coordinates(const LocalAlgebroid& algebroid, Dice& dice)
{
    const std::size_t n = algebroid.n();
    if (n < 2 || !algebroid.constraints.empty()) return algebroid;
    const std::size_t i = dice.below(n), j = (i + 1 + dice.below(n - 1)) % n;
    const Formula x = algebroid.coordinate(i), y = algebroid.coordinate(j);
    const Formula c(dice.signed_digit(2)), d(dice.signed_digit(2));
    switch (dice.below(4)) {
    case 0: return in_coordinate(algebroid, i, c * x + d * power(y, 2), (x - d * power(y, 2)) / c);
    case 1: return in_coordinate(algebroid, i, x + call("sin", y), x - call("sin", y));
    case 2: return in_coordinate(algebroid, i, x * call("exp", y), x * call("exp", -y));
    default: return in_coordinate(algebroid, i, c * x + d * y, (x - d * y) / c);
    }
}

} // namespace lagen::laws
