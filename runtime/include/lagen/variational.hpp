// SPDX-License-Identifier: MIT
/// A system together with its variational equations: integrating it carries tangent vectors along a trajectory, for
/// sensitivities, Lyapunov exponents and shooting.
///   ds/dt = rhs(t, s),   dV/dt = (d rhs / d s)(t, s) V
#pragma once

#include "lagen/kernel.hpp"

namespace lagen {

/// A right-hand side of dimension M::dimension * (1 + K): s, then K tangent vectors one after the other. M needs the
/// kernel `variational` (`lagen generate --only rhs,variational`). Domain, events and energy stay those of M.
template <class M, int K>
struct WithTangents {
    using Scalar = typename M::Scalar;
    static constexpr int dimension = M::dimension * (1 + K);
    using State = Eigen::Matrix<Scalar, dimension, 1>;
    using Point = typename M::State;

    M model;

    /// s with tangents V, shape (M::dimension, K).
    [[nodiscard]] static State state(const Point& s, const Eigen::Matrix<Scalar, M::dimension, K>& V) noexcept
    {
        State all;
        all.template head<M::dimension>() = s;
        for (int k = 0; k < K; ++k) all.template segment<M::dimension>(M::dimension * (1 + k)) = V.col(k);
        return all;
    }

    /// The tangents of a state, shape (M::dimension, K).
    [[nodiscard]] static Eigen::Matrix<Scalar, M::dimension, K> tangents(const State& all) noexcept
    {
        Eigen::Matrix<Scalar, M::dimension, K> V;
        for (int k = 0; k < K; ++k) V.col(k) = all.template segment<M::dimension>(M::dimension * (1 + k));
        return V;
    }

    [[nodiscard]] status_t<Scalar> rhs(Scalar t, const State& all, State& derivative) const noexcept
    {
        const Point s = all.template head<M::dimension>();
        Point ds;
        auto status = model.rhs(t, s, ds);
        derivative.template head<M::dimension>() = ds;
        for (int k = 0; k < K; ++k) {
            const Point v = all.template segment<M::dimension>(M::dimension * (1 + k));
            Point dv;
            status = StatusOf<Scalar>::first(status, model.variational(t, s, v, dv));
            derivative.template segment<M::dimension>(M::dimension * (1 + k)) = dv;
        }
        return status;
    }
};

} // namespace lagen
