// SPDX-License-Identifier: GPL-2.0-or-later
/// A ball that falls, for events with jumps.
#pragma once

#include "lagen/lagen.hpp"

namespace lagen::problems {

constexpr double gravity = 9.81;

/// x' = v, v' = -g: any method of order two or more is exact.
struct Ball {
    using Scalar = double;
    using State = Eigen::Matrix<double, 2, 1>;
    static constexpr int dimension = 2;
    static constexpr int base_dimension = 1;
    static constexpr SecondOrder second_order = SecondOrder::velocity_free;
    static constexpr std::array<int, 1> jacobian_rows = {0}, jacobian_columns = {1};
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double v = s[1];
        ds[0] = v;
        ds[1] = -gravity;
        return Status::ok;
    }
    void jacobian_values(double, const State&, std::array<double, 1>& values) const noexcept { values[0] = 1; }
};

using BallState = Ball::State;
using BallRequest = EventRequest<double, BallState>;

} // namespace lagen::problems
