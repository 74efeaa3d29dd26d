// SPDX-License-Identifier: GPL-2.0-or-later
/// The heavy top in body coordinates, by hand: gamma' = gamma x w, I w' = I w x w + mgl gamma x e.
#pragma once

#include <lagen/kernel.hpp>

namespace handwritten {

struct heavy_top {
    using Scalar = double;
    using State = Eigen::Matrix<double, 6, 1>; ///< g1, g2, g3, w1, w2, w3 (rad/s)
    static constexpr int dimension = 6;

    struct Parameters {
        double I1 = 1.2, I2 = 2.1, I3 = 2.9; ///< kg m^2
        double mgl = 1.7;                    ///< N m
        double e1 = 0.48, e2 = 0.6, e3 = 0.64;
    } parameters;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        const auto [I1, I2, I3, mgl, e1, e2, e3] = parameters;
        const double g1 = s[0], g2 = s[1], g3 = s[2];
        const double w1 = s[3], w2 = s[4], w3 = s[5];
        ds[0] = g2 * w3 - g3 * w2;
        ds[1] = g3 * w1 - g1 * w3;
        ds[2] = g1 * w2 - g2 * w1;
        ds[3] = ((I2 - I3) * w2 * w3 + mgl * (g2 * e3 - g3 * e2)) / I1;
        ds[4] = ((I3 - I1) * w3 * w1 + mgl * (g3 * e1 - g1 * e3)) / I2;
        ds[5] = ((I1 - I2) * w1 * w2 + mgl * (g1 * e2 - g2 * e1)) / I3;
        return lagen::Status::ok;
    }
};

} // namespace handwritten
