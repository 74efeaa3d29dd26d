// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations of motion with recurrences of Taylor coefficients written by hand.
#pragma once

#include "lagen/lagen.hpp"

namespace lagen::testing {

/// x' = c (x - x y), y' = c (x y - y): x y e^(-x - y) is constant.
template <class S>
struct Prey {
    using Scalar = S;
    using State = Eigen::Matrix<S, 2, 1>;
    static constexpr int dimension = 2;
    S c = S(1);

    Status rhs(S, const State& s, State& ds) const noexcept
    {
        ds = State(c * (s[0] - s[0] * s[1]), c * (s[0] * s[1] - s[1]));
        return Status::ok;
    }

    template <int most>
    Status taylor(S, const State& s, int order, TaylorSeries<S, 2, most>& x, S unit = S(1)) const noexcept
    {
        x[0] = {s[0], s[1]};
        x[1] = {unit * (c * (s[0] - s[0] * s[1])), unit * (c * (s[0] * s[1] - s[1]))};
        LowerSums<S, 1, most> sums;
        for (int k = 1; k < order; ++k) {
            const S product = x[k][0] * s[1] + x[k][1] * s[0] + sums(k)[0];
            const OneOver<S> next(k + 1, unit);
            x[k + 1] = {next * (c * (x[k][0] - product)), next * (c * (product - x[k][1]))};
            sums.keep(k, {x[k][0]}, {x[k][1]});
        }
        return Status::ok;
    }
};

/// x'' = -x, with events: x above 1 - 1e-10, and v.
struct Sway {
    using Scalar = double;
    using State = Eigen::Vector2d;
    static constexpr int dimension = 2;
    static constexpr std::array<const char*, 2> events_names{"top", "turn"};
    static constexpr double top = 1 - 1e-10;

    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = State(s[1], -s[0]);
        return Status::ok;
    }
    Eigen::Vector2d events(double, const State& s) const noexcept { return {s[0] - top, s[1]}; }

    template <int most>
    Status taylor(double, const State& s, int order, TaylorSeries<double, 2, most>& x) const noexcept
    {
        x[0] = {s[0], s[1]};
        for (int k = 0; k < order; ++k) x[k + 1] = {x[k][1] / (k + 1), -x[k][0] / (k + 1)};
        return Status::ok;
    }
    template <int most>
    Status event_series(double, const State&, int order, const TaylorSeries<double, 2, most>& x,
                        TaylorSeries<double, 2, most>& e) const noexcept
    {
        for (int k = 0; k <= order; ++k) e[k] = x[k];
        e[0][0] -= top;
        return Status::ok;
    }
};

/// Below its events' top and above -2.
struct Capped : Sway {
    Eigen::Vector2d domain(double, const State& s) const noexcept { return {top - s[0], 2 + s[0]}; }
    template <int most>
    Status domain_series(double, const State&, int order, const TaylorSeries<double, 2, most>& x,
                         TaylorSeries<double, 2, most>& e) const noexcept
    {
        for (int k = 0; k <= order; ++k) e[k] = {-x[k][0], x[k][0]};
        e[0][0] += top;
        e[0][1] += 2;
        return Status::ok;
    }
};

/// w' = c (w2 w3, w3 w1, w1 w2), the free rigid body, c2 < 0: w1^2/c1 - w2^2/c2 is constant.
struct TurningBody {
    using Scalar = double;
    using State = Eigen::Vector3d;
    static constexpr int dimension = 3;
    static constexpr double c1 = 0.33715271893918405, c2 = -0.7149589658329821, c3 = 0.1061033600397708;

    [[nodiscard]] static long double constant(const State& s)
    {
        const long double a = s[0], b = s[1];
        return a * a / c1 - b * b / c2;
    }
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = State(c1 * (s[1] * s[2]), c2 * (s[2] * s[0]), c3 * (s[0] * s[1]));
        return Status::ok;
    }
    template <int most>
    Status taylor(double, const State& s, int order, TaylorSeries<double, 3, most>& x, double unit = 1) const noexcept
    {
        x[0] = {s[0], s[1], s[2]};
        x[1] = {unit * (c1 * (s[1] * s[2])), unit * (c2 * (s[2] * s[0])), unit * (c3 * (s[0] * s[1]))};
        LowerSums<double, 3, most> sums;
        for (int k = 1; k < order; ++k) {
            const auto lower = sums(k);
            const OneOver<double> next(k + 1, unit);
            x[k + 1] = {next * (c1 * (s[1] * x[k][2] + s[2] * x[k][1] + lower[0])),
                        next * (c2 * (s[2] * x[k][0] + s[0] * x[k][2] + lower[1])),
                        next * (c3 * (s[0] * x[k][1] + s[1] * x[k][0] + lower[2]))};
            sums.keep(k, {x[k][1], x[k][2], x[k][0]}, {x[k][2], x[k][0], x[k][1]});
        }
        return Status::ok;
    }
};

/// One lane: x' = 1 below 0, 1 + x above it (a kink), or x' = x^2 (a pole), or a matrix that is singular from x = 1 on.
struct Ramp {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    enum class Kind { kink, pole, singular } kind = Kind::kink;

    [[nodiscard]] double rate(double x) const { return kind == Kind::pole ? x * x : (x < 0 ? 1 : 1 + x); }
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds[0] = rate(s[0]);
        return kind == Kind::singular && s[0] >= 1 ? Status::singular_mass_matrix : Status::ok;
    }
    template <int most>
    Status taylor(double, const State& s, int order, TaylorSeries<double, 1, most>& x) const noexcept
    {
        x[0][0] = s[0];
        x[1][0] = rate(s[0]);
        for (int k = 1; k < order; ++k)
            x[k + 1][0] = kind == Kind::pole ? x[k][0] * s[0] : (s[0] < 0 ? 0 : x[k][0] / (k + 1));
        return kind == Kind::singular && s[0] >= 1 ? Status::singular_mass_matrix : Status::ok;
    }
};

} // namespace lagen::testing
