// SPDX-License-Identifier: GPL-2.0-or-later
/// The planar Kepler problem, by hand: x'' = -k x / |x|^3.
#pragma once

#include <lagen/kernel.hpp>

#include <cmath>

namespace handwritten {

struct kepler {
    using Scalar = double;
    using State = Eigen::Matrix<double, 4, 1>; ///< x, y (m), u, v (m/s)
    static constexpr int dimension = 4;

    struct Parameters {
        double k = 1; ///< m^3/s^2
    } parameters;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double square = s[0] * s[0] + s[1] * s[1];
        const double factor = -parameters.k / (square * std::sqrt(square));
        ds[0] = s[2];
        ds[1] = s[3];
        ds[2] = factor * s[0];
        ds[3] = factor * s[1];
        return lagen::Status::ok;
    }
};

} // namespace handwritten
