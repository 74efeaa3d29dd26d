// SPDX-License-Identifier: GPL-2.0-or-later
/// Hand-written models with series, as classes and, exported, as compiled models: class templates by their scalars.
#pragma once

#include "runtime/taylor_models.hpp"

namespace lagen::testing {

template <class>
using Swaying = Sway;
template <class>
using CappedSway = Capped;

/// One lane, with a pole.
template <class>
struct Falling : Ramp {
    Falling() { kind = Kind::pole; }
};

/// x' = x^2 as long as x is below 3, of whose boundary no series are known.
template <class>
struct Bounded : Falling<double> {
    Eigen::Matrix<double, 1, 1> domain(double, const State& s) const noexcept
    {
        return Eigen::Matrix<double, 1, 1>(3 - s[0]);
    }
};

/// 19 lanes, which fill registers of every width and leave a rest: x_k' = (k + 1) (x_k - x_k^2).
template <class>
struct Growing {
    using Scalar = double;
    using State = Eigen::Matrix<double, 19, 1>;
    static constexpr int dimension = 19;
    static constexpr int taylor_sums = 40; // so many ask for another order than few do

    Status rhs(double, const State& s, State& ds) const noexcept
    {
        for (Eigen::Index k = 0; k < 19; ++k) ds[k] = double(k + 1) * (s[k] - s[k] * s[k]);
        return Status::ok;
    }
    template <int most>
    Status taylor(double, const State& s, int order, TaylorSeries<double, 19, most>& x, double unit = 1) const noexcept
    {
        for (std::size_t i = 0; i < 19; ++i) {
            x[0][i] = s[static_cast<Eigen::Index>(i)];
            for (int k = 0; k < order; ++k) {
                double square = 0;
                for (int j = 0; j <= k; ++j) square += x[j][i] * x[k - j][i];
                x[k + 1][i] = unit * double(i + 1) * (x[k][i] - square) / (k + 1);
            }
        }
        return Status::ok;
    }
};

} // namespace lagen::testing
