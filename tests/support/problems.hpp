// SPDX-License-Identifier: GPL-2.0-or-later
/// Nonlinear test problems written by hand for any scalar, with closed forms where they have one.
#pragma once

#include "lagen/kernel.hpp"

#include <array>
#include <cmath>

namespace lagen::problems {

/// Kepler's problem in the plane, state (q1, q2, p1, p2), unit constants.
template <class S>
struct Kepler {
    using Scalar = S;
    using State = Eigen::Matrix<S, 4, 1>;
    static constexpr int dimension = 4, base_dimension = 2, fibre_dimension = 2;

    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        using std::sqrt;
        const S x = s[0], y = s[1], square = x * x + y * y, cube = square * sqrt(square);
        const S u = s[2], v = s[3];
        ds[0] = u;
        ds[1] = v;
        ds[2] = -x / cube;
        ds[3] = -y / cube;
        return StatusOf<S>::good();
    }

    static constexpr std::array<int, 6> jacobian_rows{0, 1, 2, 2, 3, 3}, jacobian_columns{2, 3, 0, 1, 0, 1};
    void jacobian_values(S, const State& s, std::array<S, 6>& values) const noexcept
    {
        using std::sqrt;
        const S x = s[0], y = s[1], square = x * x + y * y, cube = square * sqrt(square), fifth = cube * square;
        const S mixed = S(3) * x * y / fifth;
        values = {S(1),  S(1),  S(S(3) * x * x / fifth - S(1) / cube),
                  mixed, mixed, S(S(3) * y * y / fifth - S(1) / cube)};
    }

    S energy(S, const State& s) const noexcept
    {
        using std::sqrt;
        return (s[2] * s[2] + s[3] * s[3]) / S(2) - S(1) / sqrt(s[0] * s[0] + s[1] * s[1]);
    }

    /// Semi-axis 1, pericentre at t = 0: u - e sin u = t by Newton.
    static State exact(S e, S t)
    {
        using std::cos;
        using std::sin;
        using std::sqrt;
        S u = t;
        for (int i = 0; i < 60; ++i) u -= (u - e * sin(u) - t) / (S(1) - e * cos(u));
        const S b = sqrt(S(1) - e * e), rate = S(1) / (S(1) - e * cos(u));
        return State(cos(u) - e, b * sin(u), -sin(u) * rate, b * cos(u) * rate);
    }
};

/// th'' = -sin th, state (th, w); event "bottom" at th = 0, "turn" at w = 0.
template <class S>
struct Pendulum {
    using Scalar = S;
    using State = Eigen::Matrix<S, 2, 1>;
    static constexpr int dimension = 2, base_dimension = 1, fibre_dimension = 1;
    static constexpr std::array<const char*, 2> events_names{"bottom", "turn"};

    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        using std::sin;
        const S th = s[0];
        ds[0] = s[1];
        ds[1] = -sin(th);
        return StatusOf<S>::good();
    }
    static constexpr std::array<int, 2> jacobian_rows{0, 1}, jacobian_columns{1, 0};
    void jacobian_values(S, const State& s, std::array<S, 2>& values) const noexcept
    {
        using std::cos;
        values = {S(1), S(-cos(s[0]))};
    }
    Eigen::Matrix<S, 2, 1> events(S, const State& s) const noexcept { return s; }
    S energy(S, const State& s) const noexcept
    {
        using std::cos;
        return s[1] * s[1] / S(2) - cos(s[0]);
    }
};

/// Henon and Heiles' potential, state (x, y, u, v); H = (u^2 + v^2 + x^2 + y^2)/2 + x^2 y - y^3/3.
template <class S>
struct HenonHeiles {
    using Scalar = S;
    using State = Eigen::Matrix<S, 4, 1>;
    static constexpr int dimension = 4, base_dimension = 2, fibre_dimension = 2;

    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        const S x = s[0], y = s[1];
        ds[0] = s[2];
        ds[1] = s[3];
        ds[2] = -x - S(2) * x * y;
        ds[3] = y * y - y - x * x;
        return StatusOf<S>::good();
    }
    S energy(S, const State& s) const noexcept
    {
        const S x = s[0], y = s[1];
        return (s[2] * s[2] + s[3] * s[3] + x * x + y * y) / S(2) + x * x * y - y * y * y / S(3);
    }
    static constexpr std::array<int, 6> jacobian_rows{0, 1, 2, 2, 3, 3}, jacobian_columns{2, 3, 0, 1, 0, 1};
    void jacobian_values(S, const State& s, std::array<S, 6>& values) const noexcept
    {
        values = {S(1), S(1), S(S(-1) - S(2) * s[1]), S(S(-2) * s[0]), S(S(-2) * s[0]), S(S(2) * s[1] - S(1))};
    }
};

/// Lotka-Volterra, u' = u (v - 2), v' = v (1 - u); I = ln u - u + 2 ln v - v.
template <class S>
struct LotkaVolterra {
    using Scalar = S;
    using State = Eigen::Matrix<S, 2, 1>;
    static constexpr int dimension = 2;

    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        const S u = s[0], v = s[1];
        ds[0] = u * (v - S(2));
        ds[1] = v * (S(1) - u);
        return StatusOf<S>::good();
    }
    static constexpr std::array<int, 4> jacobian_rows{0, 0, 1, 1}, jacobian_columns{0, 1, 0, 1};
    void jacobian_values(S, const State& s, std::array<S, 4>& values) const noexcept
    {
        values = {S(s[1] - S(2)), s[0], S(-s[1]), S(S(1) - s[0])};
    }
};

/// Free rigid body in momenta, moments of inertia (2, 1, 2/3); Pi' = Pi x (Pi / I).
template <class S>
struct RigidBody {
    using Scalar = S;
    using State = Eigen::Matrix<S, 3, 1>;
    static constexpr int dimension = 3;

    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        const S a = s[0], b = s[1], c = s[2], u = a / S(2), v = b, w = c * S(3) / S(2);
        ds[0] = b * w - c * v;
        ds[1] = c * u - a * w;
        ds[2] = a * v - b * u;
        return StatusOf<S>::good();
    }
    static constexpr std::array<int, 6> jacobian_rows{0, 0, 1, 1, 2, 2}, jacobian_columns{1, 2, 0, 2, 0, 1};
    void jacobian_values(S, const State& s, std::array<S, 6>& values) const noexcept
    {
        const S a = s[0], b = s[1], c = s[2];
        values = {S(c / S(2)), S(b / S(2)), S(-c), S(-a), S(b / S(2)), S(a / S(2))};
    }
};

/// Van der Pol's equation, x' = y, epsilon y' = (1 - x^2) y - x.
template <class S>
struct VanDerPol {
    using Scalar = S;
    using State = Eigen::Matrix<S, 2, 1>;
    static constexpr int dimension = 2;
    S epsilon = S(1) / S(1000000);

    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        const S x = s[0], y = s[1];
        ds[0] = y;
        ds[1] = ((S(1) - x * x) * y - x) / epsilon;
        return StatusOf<S>::good();
    }
    static constexpr std::array<int, 3> jacobian_rows{0, 1, 1}, jacobian_columns{1, 0, 1};
    void jacobian_values(S, const State& s, std::array<S, 3>& values) const noexcept
    {
        const S x = s[0], y = s[1];
        values = {S(1), S((S(-2) * x * y - S(1)) / epsilon), S((S(1) - x * x) / epsilon)};
    }
};

/// Robertson's reaction A -> B (0.04), 2 B -> B + C (3e7), B + C -> A + C (1e4).
template <class S>
struct Robertson {
    using Scalar = S;
    using State = Eigen::Matrix<S, 3, 1>;
    static constexpr int dimension = 3;

    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        const S a = s[0], b = s[1], c = s[2];
        const S first = a / S(25), second = S(30000000) * b * b, third = S(10000) * b * c;
        ds[0] = third - first;
        ds[1] = first - second - third;
        ds[2] = second;
        return StatusOf<S>::good();
    }
    static constexpr std::array<int, 7> jacobian_rows{0, 0, 0, 1, 1, 1, 2}, jacobian_columns{0, 1, 2, 0, 1, 2, 1};
    void jacobian_values(S, const State& s, std::array<S, 7>& values) const noexcept
    {
        const S b = s[1], c = s[2], rate = S(1) / S(25), second = S(60000000) * b, in_b = S(10000) * c,
                in_c = S(10000) * b;
        values = {S(-rate), in_b, in_c, rate, S(-second - in_b), S(-in_c), second};
    }
};

/// Prothero and Robinson's equation y' = lambda (y - g(t)) + g'(t), g = sin(t + 1/4): y = g, whatever lambda; the error
/// of a method shows what its stages make of it.
template <class S>
struct ProtheroRobinson {
    using Scalar = S;
    using State = Eigen::Matrix<S, 1, 1>;
    static constexpr int dimension = 1;
    S lambda = S(-1000000);

    status_t<S> rhs(S t, const State& s, State& ds) const noexcept
    {
        using std::cos;
        ds[0] = lambda * (s[0] - exact(t)) + cos(t + S(1) / S(4));
        return StatusOf<S>::good();
    }
    static constexpr std::array<int, 1> jacobian_rows{0}, jacobian_columns{0};
    void jacobian_values(S, const State&, std::array<S, 1>& values) const noexcept { values = {lambda}; }
    static S exact(S t)
    {
        using std::sin;
        return sin(t + S(1) / S(4));
    }
};

/// Restricted three-body problem in the rotating frame, mu = 0.012277471; state (x, y, x', y').
struct Arenstorf {
    using Scalar = double;
    using State = Eigen::Matrix<double, 4, 1>;
    static constexpr int dimension = 4;

    Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double mu = 0.012277471, other = 1 - mu, x = s[0], y = s[1], u = s[2], v = s[3];
        const double d1 = std::pow((x + mu) * (x + mu) + y * y, 1.5),
                     d2 = std::pow((x - other) * (x - other) + y * y, 1.5);
        ds << u, v, x + 2 * v - other * (x + mu) / d1 - mu * (x - other) / d2, y - 2 * u - other * y / d1 - mu * y / d2;
        return Status::ok;
    }
};

/// Heavy top about its fixed point, state (q0..q3 unit quaternion body to space, body angular velocity): the benchmark
/// of Bruls and Cardona, A = diag(15.234375, 0.46875, 15.234375), m g = 15 * 9.81 at (0, 1, 0) in the body, gravity
/// along -z.
struct HeavyTop {
    using Scalar = double;
    using State = Eigen::Matrix<double, 7, 1>;
    static constexpr int dimension = 7;

    Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double a = 15.234375, b = 0.46875, weight = 15 * 9.81;
        const double q0 = s[0], q1 = s[1], q2 = s[2], q3 = s[3], u = s[4], v = s[5], w = s[6];
        // The space's z axis in the body: third row of the rotation matrix of q / |q|.
        const double square = q0 * q0 + q1 * q1 + q2 * q2 + q3 * q3;
        const double g1 = 2 * (q1 * q3 - q0 * q2) / square, g3 = (q0 * q0 - q1 * q1 - q2 * q2 + q3 * q3) / square;
        ds << (-q1 * u - q2 * v - q3 * w) / 2, (q0 * u + q2 * w - q3 * v) / 2, (q0 * v + q3 * u - q1 * w) / 2,
            (q0 * w + q1 * v - q2 * u) / 2, ((b - a) * v * w - weight * g3) / a, 0.0,
            ((a - b) * u * v + weight * g1) / a;
        return Status::ok;
    }

    static State start() { return (State() << 1, 0, 0, 0, 0, 150, -4.61538).finished(); }
};

} // namespace lagen::problems
