// SPDX-License-Identifier: GPL-2.0-or-later
/// Motions that a group moves, by hand: a free body with its attitude, a heavy top on the dual of se(3).
#pragma once

#include "lagen/integrate.hpp"

#include <Eigen/Geometry>

#include <array>

namespace lagen::support {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

inline Matrix hat(const Vector& w)
{
    Matrix W;
    W << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    return W;
}

inline const Vector inertia(1.2, 2.1, 2.9);

/// I w' = I w x w + torque, R' = R hat(w), R by rows behind w; the torque is that of a spring to the vertical.
struct TurningBody {
    using Scalar = double;
    static constexpr int dimension = 12, base_dimension = 0, algebra_dimension = 3;
    using State = Eigen::Matrix<double, 12, 1>;
    static constexpr std::array<bool, 12> moved_by_group{false, false, false, true, true, true,
                                                         true,  true,  true,  true, true, true};

    static Matrix attitude(const State& s)
    {
        return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&s[3]);
    }
    static State start()
    {
        State s;
        s << 0.4, 1.5, -0.7, 1, 0, 0, 0, 1, 0, 0, 0, 1;
        return s;
    }
    double spring = 0;

    Status rhs(double t, const State& s, State& ds) const noexcept
    {
        const Vector w = s.head<3>(), momentum = inertia.cwiseProduct(w);
        const Vector torque = -spring * Vector(attitude(s).row(2)).cross(Vector(0, 0, 1));
        const Vector rate = (momentum.cross(w) + torque).cwiseQuotient(inertia);
        ds = algebra_action(t, s, w);
        ds.head<3>() = rate;
        return Status::ok;
    }
    Status algebra_element(double, const State& s, Vector& xi) const noexcept { return xi = s.head<3>(), Status::ok; }
    static State algebra_action(double, const State& s, const Vector& xi) noexcept
    {
        State ds = State::Zero();
        const Matrix rate = attitude(s) * hat(xi);
        for (int i = 0; i < 3; ++i) ds.segment<3>(3 + 3 * i) = rate.row(i);
        return ds;
    }
    static Vector algebra_bracket(const Vector& u, const Vector& v) noexcept { return u.cross(v); }
};

/// mu' = mu x w + mgl gamma x e, gamma' = gamma x w with w = mu/I; an energy that bends in gamma as well.
struct LiePoissonTop {
    using Scalar = double;
    static constexpr int dimension = 6, base_dimension = 3, algebra_dimension = 6;
    using State = Eigen::Matrix<double, 6, 1>;
    static constexpr std::array<bool, 6> moved_by_group{true, true, true, true, true, true};

    static State start()
    {
        State s;
        s << 0.6, 0.0, 0.8, 0.5, 1.0, 3.0;
        return s;
    }
    static double energy(const State& s)
    {
        const Vector mu = s.tail<3>();
        return mu.cwiseQuotient(inertia).dot(mu) / 2 + 1.7 * s[2] + 0.4 * s[0] * s[0] * s[2];
    }
    Status algebra_element(double, const State& s, State& xi) const noexcept
    {
        xi.head<3>() = s.tail<3>().cwiseQuotient(inertia);
        xi.tail<3>() = Vector(0.8 * s[0] * s[2], 0, 1.7 + 0.4 * s[0] * s[0]);
        return Status::ok;
    }
    static State algebra_action(double, const State& s, const State& xi) noexcept
    {
        const Vector gamma = s.head<3>(), mu = s.tail<3>(), w = xi.head<3>(), force = xi.tail<3>();
        State ds;
        ds.head<3>() = gamma.cross(w);
        ds.tail<3>() = mu.cross(w) + gamma.cross(force);
        return ds;
    }
    static State algebra_bracket(const State& u, const State& v) noexcept
    {
        State w;
        w.head<3>() = u.head<3>().cross(v.head<3>());
        w.tail<3>() = u.head<3>().cross(v.tail<3>()) + u.tail<3>().cross(v.head<3>());
        return w;
    }
    Status rhs(double t, const State& s, State& ds) const noexcept
    {
        State xi;
        static_cast<void>(algebra_element(t, s, xi));
        ds = algebra_action(t, s, xi);
        return Status::ok;
    }
    /// {s_i, s_j}, up to a sign: s' = B dH.
    static Eigen::Matrix<double, 6, 6> bracket(const State& s)
    {
        Eigen::Matrix<double, 6, 6> B; // columns: s' for H = mu_a, then for H = gamma_i
        for (int k = 0; k < 6; ++k) B.col((k + 3) % 6) = algebra_action(0, s, State::Unit(k));
        return B;
    }
};

/// How far R is from a rotation.
inline double off_group(const Matrix& R)
{
    return (R.transpose() * R - Matrix::Identity()).cwiseAbs().maxCoeff();
}

} // namespace lagen::support
