// SPDX-License-Identifier: GPL-2.0-or-later
/// Seven bodies in the plane with G = 1, by hand: each pair once, q_i'' = -sum_j m_j (q_i - q_j) / |q_i - q_j|^3.
#pragma once

#include <lagen/kernel.hpp>

#include <array>
#include <cmath>

namespace handwritten {

struct pleiades {
    using Scalar = double;
    using State = Eigen::Matrix<double, 28, 1>; ///< x, y of all seven, then their velocities
    static constexpr int dimension = 28;
    static constexpr int bodies = 7;

    struct Parameters {
        std::array<double, bodies> m{1, 2, 3, 4, 5, 6, 7};
    } parameters;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        const auto& m = parameters.m;
        std::array<double, bodies> ax{};
        std::array<double, bodies> ay{};
        for (int i = 0; i < bodies; ++i)
            for (int j = i + 1; j < bodies; ++j) {
                const double dx = s[i] - s[j];
                const double dy = s[bodies + i] - s[bodies + j];
                const double square = dx * dx + dy * dy;
                const double w = 1 / (square * std::sqrt(square));
                const std::size_t a = static_cast<std::size_t>(i);
                const std::size_t b = static_cast<std::size_t>(j);
                ax[a] -= m[b] * w * dx;
                ay[a] -= m[b] * w * dy;
                ax[b] += m[a] * w * dx;
                ay[b] += m[a] * w * dy;
            }
        for (int i = 0; i < 2 * bodies; ++i) ds[i] = s[2 * bodies + i];
        for (int i = 0; i < bodies; ++i) {
            ds[2 * bodies + i] = ax[static_cast<std::size_t>(i)];
            ds[3 * bodies + i] = ay[static_cast<std::size_t>(i)];
        }
        return lagen::Status::ok;
    }
};

} // namespace handwritten
