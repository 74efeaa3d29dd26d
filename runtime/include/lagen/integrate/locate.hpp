// SPDX-License-Identifier: MIT
/// Roots and boundaries inside a step, on the step's own variable theta in [0, 1].
#pragma once

#include "lagen/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lagen::detail {

/// A bracket that has shrunk to `width`: the sign at `after` is that at the end of the first bracket.
template <class Real>
struct Bracket {
    Real before;
    Real after;
};

/// The boundary between a, where `inside` holds, and b, where it does not.
template <class Real, class Predicate>
Bracket<Real> locate_boundary(Real a, Real b, Real width, const Predicate& inside) noexcept
{
    while (b - a > width) {
        const Real middle = (a + b) / Real(2);
        if (!(middle > a && middle < b)) break;
        (inside(middle) ? a : b) = middle;
    }
    return {a, b};
}

/// The last theta, to `width`, before a gap that begins between a and b, where `value` is not a number.
template <class Real, class Function>
Real end_of_defined(Real a, Real b, Real width, const Function& value) noexcept
{
    return locate_boundary(a, b, width, [&](Real x) { return is_number(value(x)); }).before;
}

/// The crossing of `value` between a (value ga) and b (value gb of the other sign, or zero), where it leaves zero: the
/// Illinois variant of regula falsi [Dowell and Jarratt 1971], every third trial a bisection, so that the bracket
/// shrinks at least by 2 in three trials. Where a trial is not a number the crossing is looked for before that gap,
/// else behind it.
template <class Real, class Function>
Bracket<Real> locate_crossing(Real a, Real ga, Real b, Real gb, Real width, const Function& value) noexcept
{
    const bool rising = ga < Real(0);
    int kept = 0;
    for (int trial = 0; trial < 240 && b - a > width; ++trial) {
        Real x = (a + b) / Real(2);
        if (trial % 3 != 2 && gb != ga) {
            // A trial within the width of an end would not shrink the bracket below it: step just inside.
            const Real least = std::min<Real>(width, (b - a) / Real(2)) * Real(0.75);
            const Real secant = b - gb * (b - a) / (gb - ga);
            if (secant > a && secant < b) x = std::clamp<Real>(secant, a + least, b - least);
        }
        if (!(x > a && x < b)) break;
        Real g = value(x);
        if (!is_number(g)) {
            const Real end = end_of_defined(a, x, width, value);
            const Real at_end = value(end);
            if (rising ? at_end >= Real(0) : at_end <= Real(0)) {
                x = end;
                g = at_end;
            }
        }
        const bool crossed = rising ? g > Real(0) : g < Real(0);
        if (crossed) {
            b = x;
            gb = g;
            if (kept > 0) ga /= Real(2);
            kept = 1;
        } else {
            a = x;
            ga = g;
            if (kept < 0) gb /= Real(2);
            kept = -1;
        }
    }
    return {a, b};
}

/// Between a and b, where `value` has one sign (values ga and gb), a place where it has the other: beyond the turning
/// point of a function that comes nearer to zero at a and leaves it at b. Nothing where a convex one does not reach
/// zero, whose tangents at two places meet below it.
template <class Real, class Function>
std::optional<Real> locate_turn(Real a, Real ga, Real b, Real gb, Real width, const Function& value) noexcept
{
    const Real side = ga > Real(0) ? Real(1) : Real(-1), part = Real(1) / Real(1024);
    if (!(side * ga > Real(0) && side * gb > Real(0))) return std::nullopt;
    const auto slope = [&](Real x, Real gx, Real dx) { return side * (value(x + dx) - gx) / dx; };
    Real rise = slope(b, gb, part * (a - b));
    if (!(rise > Real(0))) return std::nullopt;
    Real fall = slope(a, ga, part * (b - a));
    for (int trial = 0; trial < 100 && fall < Real(0) && b - a > width; ++trial) {
        const Real behind = (side * (gb - ga) - rise * (b - a)) / (fall - rise); // a + behind: there the tangents meet
        if (side * ga + fall * behind > Real(0)) return std::nullopt;
        const Real least = (b - a) / Real(16);
        const Real middle = a + std::clamp<Real>(behind, least, Real(15) * least), gm = value(middle);
        if (!is_number(gm)) return std::nullopt;
        if (side * gm < Real(0)) return middle;
        const Real there = slope(middle, gm, part * (b - middle));
        if (there < Real(0)) {
            a = middle, ga = gm, fall = there;
        } else {
            b = middle, gb = gm, rise = there;
        }
    }
    return std::nullopt;
}

} // namespace lagen::detail
