// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact interval arithmetic with open and closed ends.
#include "proof/range.hpp"

#include <array>

namespace lagen::proof {

namespace {

/// Orders ends of the extended line; `infinity` is the sign that an infinite end has.
struct Extended {
    int infinity = 0; ///< -1, 0 (finite), +1
    mpq_class value;
    bool open = true;
};

bool less(const Extended& a, const Extended& b)
{
    if (a.infinity != b.infinity) return a.infinity < b.infinity;
    return a.infinity == 0 && a.value < b.value;
}

bool same(const Extended& a, const Extended& b)
{
    return a.infinity == b.infinity && (a.infinity != 0 || a.value == b.value);
}

Extended extended(const End& end, int infinity)
{
    return end.infinite ? Extended{infinity, 0, true} : Extended{0, end.value, end.open};
}

End finite_end(const Extended& e)
{
    return e.infinity != 0 ? End{} : End{false, e.value, e.open};
}

int sign(const Extended& e)
{
    return e.infinity != 0 ? e.infinity : sgn(e.value);
}

/// 0 * infinity is 0 here: the products that approach an infinite end start at 0. A zero product is attained as soon
/// as one of the factors can be 0.
Extended product(const Extended& a, const Extended& b, bool zero_attained)
{
    if (sign(a) == 0 || sign(b) == 0) return {0, 0, !zero_attained};
    if (a.infinity != 0 || b.infinity != 0) return {sign(a) * sign(b), 0, true};
    return {0, a.value * b.value, a.open || b.open};
}

End sum(const End& a, const End& b)
{
    if (a.infinite || b.infinite) return {};
    return {false, a.value + b.value, a.open || b.open};
}

} // namespace

Range Range::point(const mpq_class& value)
{
    return between(value, value);
}

Range Range::between(const mpq_class& low, const mpq_class& high)
{
    return {End{false, low, false}, End{false, high, false}, false};
}

Range Range::positive()
{
    return {End{false, 0, true}, End{}, true};
}

Range Range::nonnegative()
{
    return {End{false, 0, false}, End{}, false};
}

bool Range::contains_zero() const
{
    if (nonzero) return false;
    if (!low.infinite && (sgn(low.value) > 0 || (sgn(low.value) == 0 && low.open))) return false;
    return high.infinite || sgn(high.value) > 0 || (sgn(high.value) == 0 && !high.open);
}

Range operator+(const Range& a, const Range& b)
{
    return {sum(a.low, b.low), sum(a.high, b.high), false};
}

Range operator*(const Range& a, const Range& b)
{
    const bool zero_attained = a.contains_zero() || b.contains_zero();
    const std::array<Extended, 2> ends_a{extended(a.low, -1), extended(a.high, 1)};
    const std::array<Extended, 2> ends_b{extended(b.low, -1), extended(b.high, 1)};
    Extended low{1, 0, true}, high{-1, 0, true};
    for (const Extended& x : ends_a)
        for (const Extended& y : ends_b) {
            const Extended p = product(x, y, zero_attained);
            if (same(p, low)) low.open = low.open && p.open;
            if (less(p, low)) low = p;
            if (same(p, high)) high.open = high.open && p.open;
            if (less(high, p)) high = p;
        }
    return {finite_end(low), finite_end(high), !zero_attained};
}

Range power(const Range& a, unsigned exponent)
{
    Range result = Range::point(1);
    for (unsigned k = 0; k < exponent && k < 64; ++k) result = result * a;
    if (exponent >= 64) result = Range{};
    if (exponent % 2 == 0) {
        // Multiplying a by itself forgets that both factors have one sign.
        Range even = a.contains_zero() ? Range::nonnegative() : Range::positive();
        even.high = result.high;
        const Range magnitude = intersect(even, result);
        result = magnitude;
    }
    result.nonzero = exponent == 0 || !a.contains_zero();
    return result;
}

Range intersect(const Range& a, const Range& b)
{
    Range result = a;
    if (!b.low.infinite && (a.low.infinite || a.low.value < b.low.value)) result.low = b.low;
    if (!b.low.infinite && !a.low.infinite && a.low.value == b.low.value) result.low.open = a.low.open || b.low.open;
    if (!b.high.infinite && (a.high.infinite || b.high.value < a.high.value)) result.high = b.high;
    if (!b.high.infinite && !a.high.infinite && a.high.value == b.high.value)
        result.high.open = a.high.open || b.high.open;
    result.nonzero = a.nonzero || b.nonzero;
    return result;
}

Signs signs_of(const Range& range)
{
    Signs signs;
    signs.zero = range.contains_zero();
    signs.negative = range.low.infinite || sgn(range.low.value) < 0;
    signs.positive = range.high.infinite || sgn(range.high.value) > 0;
    return signs;
}

Signs signs_of(const mpz_class& value)
{
    return {sgn(value) < 0, sgn(value) == 0, sgn(value) > 0};
}

Signs operator*(const Signs& a, const Signs& b)
{
    return {(a.negative && b.positive) || (a.positive && b.negative), a.zero || b.zero,
            (a.positive && b.positive) || (a.negative && b.negative)};
}

Signs operator+(const Signs& a, const Signs& b)
{
    const bool opposite = (a.negative && b.positive) || (a.positive && b.negative);
    return {a.negative || b.negative, (a.zero && b.zero) || opposite, a.positive || b.positive};
}

Signs operator-(const Signs& a)
{
    return {a.positive, a.zero, a.negative};
}

Signs power(const Signs& a, unsigned exponent)
{
    if (exponent == 0) return {false, false, true};
    if (exponent % 2 == 1) return a;
    return {false, a.zero, a.negative || a.positive};
}

Signs both(const Signs& a, const Signs& b)
{
    return {a.negative && b.negative, a.zero && b.zero, a.positive && b.positive};
}

} // namespace lagen::proof
