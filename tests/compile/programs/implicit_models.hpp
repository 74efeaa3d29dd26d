// SPDX-License-Identifier: GPL-2.0-or-later
/// Models with Jacobians for implicit methods, small and stiff or with a narrow band, as classes and as shared objects.
#pragma once

#include "lagen/kernel.hpp"

#include <array>
#include <cmath>

namespace lagen::models {

/// y' = -1000 (y - cos t), one lane.
template <class S>
struct relaxation {
    using Scalar = S;
    static constexpr int dimension = 1;
    using State = Eigen::Matrix<S, 1, 1>;
    static constexpr std::array<int, 1> jacobian_rows{0}, jacobian_columns{0};

    Status rhs(S t, const State& s, State& rate) const noexcept
    {
        rate[0] = S(-1000) * (s[0] - std::cos(t));
        return Status::ok;
    }
    void jacobian_values(S, const State&, std::array<S, 1>& values) const noexcept { values[0] = S(-1000); }
};

/// Van der Pol's oscillator with the damping 100, stiff between its jumps.
template <class S>
struct van_der_pol {
    using Scalar = S;
    static constexpr int dimension = 2;
    using State = Eigen::Matrix<S, 2, 1>;
    static constexpr std::array<int, 3> jacobian_rows{0, 1, 1}, jacobian_columns{1, 0, 1};

    Status rhs(S, const State& s, State& rate) const noexcept
    {
        const S x = s[0], v = s[1];
        rate[0] = v;
        rate[1] = S(100) * (S(1) - x * x) * v - x;
        return Status::ok;
    }
    void jacobian_values(S, const State& s, std::array<S, 3>& values) const noexcept
    {
        values = {S(1), S(-200) * s[0] * s[1] - S(1), S(100) * (S(1) - s[0] * s[0])};
    }
};

/// 16 masses on a line between walls, springs of force d + d^3 between neighbours.
template <class S>
struct lattice {
    using Scalar = S;
    static constexpr int n = 16, dimension = 2 * n;
    using State = Eigen::Matrix<S, dimension, 1>;
    static constexpr std::size_t entries = 4 * n - 2;
    static constexpr auto pattern = [] {
        std::array<std::array<int, entries>, 2> found{};
        std::size_t k = 0;
        for (int i = 0; i < n; ++i) found[0][k] = i, found[1][k++] = n + i;
        for (int i = 0; i < n; ++i)
            for (int j = i > 0 ? i - 1 : 0; j <= i + 1 && j < n; ++j) found[0][k] = n + i, found[1][k++] = j;
        return found;
    }();
    static constexpr auto jacobian_rows = pattern[0], jacobian_columns = pattern[1];

    static S stretch(const State& s, int i) noexcept { return (i < n ? s[i] : S(0)) - (i > 0 ? s[i - 1] : S(0)); }
    static S slope(const State& s, int i) noexcept { return S(1) + S(3) * stretch(s, i) * stretch(s, i); }

    Status rhs(S, const State& s, State& rate) const noexcept
    {
        const auto force = [&](int i) { return stretch(s, i) + stretch(s, i) * stretch(s, i) * stretch(s, i); };
        for (int i = 0; i < n; ++i) {
            rate[i] = s[n + i];
            rate[n + i] = force(i + 1) - force(i);
        }
        return Status::ok;
    }
    void jacobian_values(S, const State& s, std::array<S, entries>& values) const noexcept
    {
        std::size_t k = 0;
        for (int i = 0; i < n; ++i) values[k++] = S(1);
        for (int i = 0; i < n; ++i) {
            if (i > 0) values[k++] = slope(s, i);
            values[k++] = -slope(s, i) - slope(s, i + 1);
            if (i + 1 < n) values[k++] = slope(s, i + 1);
        }
    }
};

/// A model without a Jacobian.
template <class S>
struct decay {
    using Scalar = S;
    static constexpr int dimension = 1;
    using State = Eigen::Matrix<S, 1, 1>;

    Status rhs(S, const State& s, State& rate) const noexcept
    {
        rate[0] = -s[0];
        return Status::ok;
    }
};

} // namespace lagen::models
