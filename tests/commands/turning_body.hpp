// SPDX-License-Identifier: GPL-2.0-or-later
/// What every method has to keep of turning_body.toml.
#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

namespace lagen::testing {

/// Of a row t, space, R: the momentum in space R I w is that of the start, within `margin`, and R has turned and is a
/// rotation.
inline void check_turned(const std::vector<double>& row, double margin)
{
    REQUIRE(row.size() == 13);
    CHECK(row[1] == Approx(0.3).margin(margin));
    CHECK(row[2] == Approx(2).margin(margin));
    CHECK(row[3] == Approx(0.6).margin(margin));
    const double* R = &row[4];
    CHECK(std::abs(R[0] - 1) > 0.01);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double product = i == j ? -1 : 0;
            for (int k = 0; k < 3; ++k) product += R[3 * k + i] * R[3 * k + j];
            CHECK(std::abs(product) < 2e-14);
        }
}

} // namespace lagen::testing
