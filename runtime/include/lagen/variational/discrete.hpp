// SPDX-License-Identifier: MIT
/// Discrete Euler-Lagrange equations as a one-step method: `lagen::integrate(model, s, {0, n * h}, lagen::Discrete{})`.
/// A state is (x, g, mu): the arrow g = (x, x_next, W) of the step that begins at x, and its momenta mu = F^-L(g). A
/// step goes on to x' = t(g) and mu' = F^+L(g), and solves F^-L(g') = mu' for the next arrow (variational/arrow.hpp).
/// It is symplectic (a Poisson map of E*), and keeps momenta of symmetries to round-off.        [Martinez 2001]
#pragma once

#include "lagen/newton.hpp"
#include "lagen/run.hpp"
#include "lagen/variational/arrow.hpp"

namespace lagen {

/// The stepper of a discrete motion: see integrate/stepper.hpp for what is asked of it.
template <DiscreteMotion M>
class DiscreteStepper {
  public:
    using Scalar = typename M::Scalar;
    using Real = step_time_t<M>;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int dense_order = 0;

    template <class Method>
    explicit DiscreteStepper(const Method&) noexcept
    {
    }

    /// Solves for the first arrow from the one in s, which stays where it belongs to the momenta; invalid_input where
    /// that is plainly no element of the group.
    Status begin(const M& model, const Real& t, State& s) noexcept
    {
        drift_.setZero();
        if (detail::is_off_group(model, Scalar(t), s)) return Status::invalid_input;
        return solver_.solve(model, Scalar(t), s);
    }

    /// `h` is the model's step: any other is invalid_input.
    Status attempt(const M& model, const Real& t, const State& s, const Real& h, State& s1) noexcept
    {
        if (!detail::is_own_step(model, t, h)) return Status::invalid_input;
        if constexpr (has_explicit_step) {
            ++explicit_steps_;
            s1 = model.explicit_step(Scalar(t), s);
            return s1.allFinite() ? Status::ok : Status::non_finite;
        } else {
            return solve_step(model, t, Real(model.step()), s, s1);
        }
    }

    void accept() noexcept { drift_ = next_drift_; }
    /// Behind a step that failed.
    void forget() noexcept { drift_.setZero(); }

    /// A discrete motion has no values inside of its steps.
    Status interpolate(const M&, const Real&, const State&, const Real&, const State&, const Real&, State& out) noexcept
    {
        out.setConstant(Scalar(std::numeric_limits<real_t<Scalar>>::quiet_NaN()));
        return Status::ok;
    }

    [[nodiscard]] std::size_t calls() const noexcept { return solver_.evaluations() + explicit_steps_; }
    [[nodiscard]] std::size_t newton_iterations() const noexcept { return solver_.evaluations(); }
    [[nodiscard]] std::size_t decompositions() const noexcept { return solver_.decompositions(); }

  private:
    using Lanes = detail::ArrowLanes<M>;
    using Column = Eigen::Matrix<Scalar, Lanes::unknowns, 1>;
    static constexpr bool has_explicit_step = requires(const M& model, const State& s)
    {
        model.explicit_step(s[0], s);
    };

    [[nodiscard]] Status solve_step(const M& model, const Real& t, const Real& length, const State& s,
                                    State& s1) noexcept
    {
        Eigen::Matrix<Scalar, Lanes::n, 1> x;
        Eigen::Matrix<Scalar, Lanes::rank, 1> mu;
        model.forward(Scalar(t), s, x, mu);
        s1 = s;
        for (int i = 0; i < Lanes::n; ++i) s1[i] = x[i];
        for (int a = 0; a < Lanes::rank; ++a) s1[Lanes::momenta + a] = mu[a];
        const Scalar t1(t + length);
        detail::renew_group_part(model, t1, s1);
        const State before = s1;
        Column ahead = drift_;
        if (!detail::move_arrow(model, t1, s1, ahead)) s1 = before, ahead.setZero();
        const Status status = solver_.solve(model, t1, s1, &before, ahead);
        next_drift_ = solver_.moved();
        return status;
    }

    ArrowSolver<M> solver_;
    std::size_t explicit_steps_ = 0;
    Column drift_ = Column::Zero(), next_drift_ = Column::Zero(); ///< how the arrow of the last step moved
};

/// The discrete motion of a model with a discrete Lagrangian; its step is that of the model.
struct Discrete {
    template <class M>
    using Stepper = DiscreteStepper<M>;
};

/// The state s with the momenta of its arrow, mu = F^-L(g). Inner unknowns are found first, by Newton's method for
/// dL/dw = 0 from the ones in s; the momenta are NaN where it finds none.
template <DiscreteMotion M>
[[nodiscard]] typename M::State at_arrow(const M& model, const typename M::Scalar& t, typename M::State s) noexcept
{
    using S = typename M::Scalar;
    using Lanes = detail::ArrowLanes<M>;
    bool found = true;
    if constexpr (Lanes::inner > 0) {
        constexpr auto count = static_cast<std::size_t>(Lanes::inner);
        std::array<S, count> w;
        for (std::size_t k = 0; k < count; ++k) w[k] = s[Lanes::within + static_cast<int>(k)];
        const auto equations = [&](const std::array<S, count>& at, std::array<S, count>& F,
                                   std::array<S, count * count>& slopes) {
            Eigen::Matrix<S, Lanes::unknowns, 1> R;
            Eigen::Matrix<S, Lanes::unknowns, Lanes::unknowns> N;
            typename M::State z = s;
            for (std::size_t k = 0; k < count; ++k) z[Lanes::within + static_cast<int>(k)] = at[k];
            model.arrow_equation(t, z, R, N);
            for (std::size_t k = 0; k < count; ++k) {
                const int row = Lanes::rank + static_cast<int>(k);
                F[k] = -R[row];
                for (std::size_t l = 0; l < count; ++l)
                    slopes[k * count + l] = N(row, Lanes::rank + static_cast<int>(l));
            }
        };
        found = newton<S>(w, equations) == Status::ok;
        for (std::size_t k = 0; k < count; ++k) s[Lanes::within + static_cast<int>(k)] = w[k];
    }
    const auto mu = model.momentum(t, s);
    const S none(std::numeric_limits<real_t<S>>::quiet_NaN());
    for (int a = 0; a < Lanes::rank; ++a) s[Lanes::momenta + a] = found ? mu[a] : none;
    return s;
}

} // namespace lagen
