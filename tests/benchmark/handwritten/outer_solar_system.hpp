// SPDX-License-Identifier: GPL-2.0-or-later
/// The Sun and five planets, by hand: each pair once, q_i'' = -G sum_j m_j (q_i - q_j) / |q_i - q_j|^3.
#pragma once

#include <lagen/kernel.hpp>

#include <array>
#include <cmath>

namespace handwritten {

struct outer_solar_system {
    using Scalar = double;
    using State = Eigen::Matrix<double, 36, 1>; ///< positions, body by body (AU), then velocities (AU/d)
    static constexpr int dimension = 36;
    static constexpr std::size_t bodies = 6;

    struct Parameters {
        double G = 2.95912208286e-4; ///< AU^3/d^2, masses in units of the Sun's
        std::array<double, bodies> m{1.00000597682,      0.000954786104043,  0.000285583733151,
                                     0.0000437273164546, 0.0000517759138449, 1 / 1.3e8};
    } parameters;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        const auto& [G, m] = parameters;
        const double* const q = s.data();
        std::array<double, 3 * bodies> a{};
        for (std::size_t i = 0; i < bodies; ++i)
            for (std::size_t j = i + 1; j < bodies; ++j) {
                const double x = q[3 * i] - q[3 * j];
                const double y = q[3 * i + 1] - q[3 * j + 1];
                const double z = q[3 * i + 2] - q[3 * j + 2];
                const double square = x * x + y * y + z * z;
                const double w = G / (square * std::sqrt(square));
                const double wi = m[i] * w;
                const double wj = m[j] * w;
                a[3 * i] -= wj * x;
                a[3 * i + 1] -= wj * y;
                a[3 * i + 2] -= wj * z;
                a[3 * j] += wi * x;
                a[3 * j + 1] += wi * y;
                a[3 * j + 2] += wi * z;
            }
        for (int k = 0; k < 18; ++k) ds[k] = s[18 + k];
        for (std::size_t k = 0; k < a.size(); ++k) ds[18 + static_cast<int>(k)] = a[k];
        return lagen::Status::ok;
    }
};

} // namespace handwritten
