// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/rational_near.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

std::optional<Rational> rational_near(long double x, long double tolerance)
{
    constexpr long most = 100000;
    long p0 = 0, q0 = 1, p1 = 1, q1 = 0;
    long double rest = x;
    for (int k = 0; k < 30; ++k) {
        const long double whole = std::floor(rest);
        if (std::abs(whole) > 1e8L) return {};
        const long a = static_cast<long>(whole), p = a * p1 + p0, q = a * q1 + q0;
        if (q > most) return {};
        p0 = p1, q0 = q1, p1 = p, q1 = q;
        if (std::abs(x - static_cast<long double>(p) / static_cast<long double>(q)) <=
            tolerance * std::max(1.0L, std::abs(x)))
            return Rational(p, q);
        rest = 1 / (rest - whole);
    }
    return {};
}

} // namespace lagen
