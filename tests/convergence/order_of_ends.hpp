// SPDX-License-Identifier: GPL-2.0-or-later
/// Orders of methods of fixed step, measured in 37 digits.
#pragma once

#include "support/order.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

namespace lagen::testing {

/// end(steps) is the state at t = 4 by so many steps. Of `coarsest` steps and `count - 1` times twice as many, against
/// a quarter of the shortest one.
template <class End>
double order_of_ends(const End& end, int coarsest, int count)
{
    const auto exact = end(coarsest << (count + 1));
    std::vector<support::ErrorPoint> points;
    for (int k = 0; k < count; ++k)
        points.push_back({4.0L / (coarsest << k), static_cast<long double>((end(coarsest << k) - exact).norm())});
    return support::measured_order(points, 1e-30L);
}

inline auto near(double order)
{
    return Catch::WithinAbs(order, tolerance::order);
}

} // namespace lagen::testing
