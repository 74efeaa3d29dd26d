// SPDX-License-Identifier: GPL-2.0-or-later
/// Identities of each function class.
#include "disguise.hpp"

namespace lagen::laws {
namespace {

Formula root(const Formula& u)
{
    return call("sqrt", u);
}

Formula square(const Formula& u)
{
    return power(u, 2);
}

Formula two(const Formula& u)
{
    return Formula(2) * u;
}

} // namespace

std::vector<Formula> hidden_zeros(const Formula& x, const Formula& y)
{
    const Formula one(1), half(mpq_class(1, 2));
    const Formula s = call("sin", x), c = call("cos", x), e = call("exp", x);
    return {
        square(s) + square(c) - one,
        call("sin", two(x)) - two(s * c),
        call("cos", x + y) - c * call("cos", y) + s * call("sin", y),
        call("sin", Formula(3) * x) - Formula(3) * s + Formula(4) * power(s, 3),
        call("tan", x) * c - s,
        one + square(call("tan", x)) - power(c, -2),
        two(square(call("sin", half * x))) - one + c,
        call("exp", x + y) - e * call("exp", y),
        e * call("exp", -x) - one,
        square(call("cosh", x)) - square(call("sinh", x)) - one,
        call("cosh", x) + call("sinh", x) - e,
        call("tanh", x) * call("cosh", x) - call("sinh", x),
        call("log", e) - x,
        root(call("exp", two(x))) - e,
        square(root(one + square(x))) - one - square(x),
        root((one + square(x)) * (Formula(4) + square(y))) - root(one + square(x)) * root(Formula(4) + square(y)),
        root(power(x, 4)) - square(x),
        square(call("abs", x)) - square(x),
        root(square(x)) - call("abs", x),
        two(call("log", one + square(x))) - call("log", square(one + square(x))),
        (square(x) - Formula(4)) / (x - Formula(2)) - x - Formula(2),
        power(one + x, -1) + power(one - x, -1) - two(power(one - square(x), -1)),
        root(Formula(5) + two(root(6))) - root(2) - root(3),
        root(2) * root(3) - root(6),
        call("sin", call("atan", x)) - x / root(one + square(x)),
    };
}

std::vector<Formula> hidden_zeros_of_positive(const Formula& x, const Formula& y)
{
    const Formula log_x = call("log", x), log_y = call("log", y);
    return {
        root(square(x)) - x,
        call("abs", x) - x,
        call("log", x * y) - log_x - log_y,
        call("log", square(x)) - two(log_x),
        call("log", x / y) - log_x + log_y,
        root(x * y) - root(x) * root(y),
        call("exp", log_x) - x,
        call("exp", two(log_x)) - square(x),
        call("exp", mpq_class(1, 2) * log_x) - root(x),
        root(square(x) + two(x * y) + square(y)) - x - y,
        square(root(x)) - x,
        root(power(x, 3)) - x * root(x),
        root(square(x) * square(y)) - x * y,
        two(call("log", root(x))) - log_x,
    };
}

std::vector<Formula> half_zeros(const Formula& x, const Formula& y)
{
    return {
        root(square(x)) - x,
        call("abs", x) - x,
        root(square(x) * square(y)) - x * y,
        root(square(x - y)) - x + y,
        root(Formula(1) - square(call("sin", x))) - call("cos", x),
        call("atan", call("tan", x)) - x,
        mpq_class(1, 2) * call("log", square(x)) - call("log", root(square(y)) * x) + call("log", call("abs", y)) +
            call("abs", x) - x,
        root(square(x) - two(x) + Formula(1)) - x + Formula(1),
        call("abs", x * y) - x * call("abs", y),
        root(square(call("cos", x))) - call("cos", x),
    };
}

LocalAlgebroid disguised(const LocalAlgebroid& algebroid, bool positive, Dice& dice)
{
    LocalAlgebroid result = algebroid;
    const std::size_t n = result.n(), r = result.r();
    if (n == 0 || r == 0) return result;
    for (std::size_t count = 1 + dice.below(3); count > 0; --count) {
        const Formula x = result.coordinate(dice.below(n)), y = result.coordinate(dice.below(n));
        const std::size_t from_positive = positive ? 3 : 0;
        const Formula zero =
            dice.pick(dice.below(4) < from_positive ? hidden_zeros_of_positive(x, y) : hidden_zeros(x, y));
        const std::size_t a = dice.below(r), b = r > 1 ? (a + 1 + dice.below(r - 1)) % r : a;
        if (a != b && dice.flip()) {
            const std::size_t c = dice.below(r);
            result.add_to_bracket(c, a, b, zero * Formula(dice.signed_digit(3)));
        } else {
            Formula& entry = result.anchor(dice.below(n), a);
            entry = entry.is_zero() || dice.flip() ? entry + zero : entry * (Formula(1) + zero);
        }
    }
    return result;
}

} // namespace lagen::laws
