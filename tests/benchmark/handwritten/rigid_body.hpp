// SPDX-License-Identifier: GPL-2.0-or-later
/// Euler's equations of the free rigid body, by hand: I1 w1' = (I2 - I3) w2 w3 and cyclic.
#pragma once

#include <lagen/kernel.hpp>

namespace handwritten {

struct rigid_body {
    using Scalar = double;
    using State = Eigen::Matrix<double, 3, 1>; ///< w1, w2, w3 (rad/s)
    static constexpr int dimension = 3;

    struct Parameters {
        double I1 = 1.1, I2 = 2.3, I3 = 3.4; ///< kg m^2
    } parameters;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        const auto [I1, I2, I3] = parameters;
        const double w1 = s[0], w2 = s[1], w3 = s[2];
        ds[0] = (I2 - I3) * w2 * w3 / I1;
        ds[1] = (I3 - I1) * w3 * w1 / I2;
        ds[2] = (I1 - I2) * w1 * w2 / I3;
        return lagen::Status::ok;
    }
};

} // namespace handwritten
