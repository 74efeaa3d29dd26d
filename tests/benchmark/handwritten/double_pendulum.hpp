// SPDX-License-Identifier: GPL-2.0-or-later
/// The planar double pendulum, by hand. With M = m1 + m2, c = cos(a - b), s = sin(a - b), Lagrange's equations divided
/// by l1 and by m2 l2 are
///   M l1 u' + m2 c l2 v' = f1 = -m2 s l2 v^2 - M g sin a,      c l1 u' + l2 v' = f2 = s l1 u^2 - g sin b,
/// solved by the adjugate; sin and cos of the difference come from those of a and b, which are needed anyway.
#pragma once

#include <lagen/kernel.hpp>

#include <cmath>

namespace handwritten {

struct double_pendulum {
    using Scalar = double;
    using State = Eigen::Matrix<double, 4, 1>; ///< a, b (rad), u, v (rad/s)
    static constexpr int dimension = 4;

    struct Parameters {
        double m1 = 1, m2 = 0.6; ///< kg
        double l1 = 1, l2 = 0.8; ///< m
        double g = 9.81;         ///< m/s^2
    } parameters;

    lagen::Status rhs(double, const State& x, State& dx) const noexcept
    {
        const auto [m1, m2, l1, l2, g] = parameters;
        const double u = x[2], v = x[3];
        const double sin_a = std::sin(x[0]), cos_a = std::cos(x[0]);
        const double sin_b = std::sin(x[1]), cos_b = std::cos(x[1]);
        const double s = sin_a * cos_b - cos_a * sin_b;
        const double c = cos_a * cos_b + sin_a * sin_b;

        const double M = m1 + m2;
        const double m2c = m2 * c;
        const double f1 = -m2 * s * l2 * v * v - M * g * sin_a;
        const double f2 = s * l1 * u * u - g * sin_b;
        const double inverse = 1 / ((M - m2c * c) * l1 * l2);
        dx[0] = u;
        dx[1] = v;
        dx[2] = (f1 - m2c * f2) * l2 * inverse;
        dx[3] = (M * f2 - c * f1) * l1 * inverse;
        return lagen::Status::ok;
    }
};

} // namespace handwritten
