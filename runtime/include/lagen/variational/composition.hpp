// SPDX-License-Identifier: MIT
/// Methods of high order composed of steps of one symmetric discrete Lagrangian of order 2,
///   Phi_h = phi_{g_1 h} o .. o phi_{g_s h},      phi_h: (x, F^-L(g)) -> (t(g), F^+L(g)),      g_k = g_{s+1-k}
///   Discrete4{}   five steps   [Suzuki, Physics Letters A 146 (1990) 319]
///   Discrete6{}   nine         [Kahan, Li, Mathematics of Computation 66 (1997) 1089, s9odr6a]
///   Discrete8{}   17           [the same, s17odr8a]
/// L is symmetric where L(t, g, h) + L(t + h, g^-1, -h) is constant on the arrows; that is the caller's to know (`lagen
/// run` proves it). Where it is not the order is lower. Symplectic or Poisson as the steps are, with their momenta.
///
/// A state stands between whole steps: its arrow is the product of the arrows of the step that begins at its point, mu
/// is F^-L of the first of them, and inner unknowns are 0. The first arrow of a motion is the one that is connected
/// with the arrow 1. The guess for each arrow is the one before, scaled to its length.
#pragma once

#include "lagen/integrate/splitting_coefficients.hpp"
#include "lagen/variational/discrete.hpp"

#include <array>

namespace lagen {

/// The stepper of such a composition: see integrate/stepper.hpp for what is asked of it.
template <class Leapfrogs, DiscreteMotion M>
class CompositionStepper {
    static_assert(
        HasParameters<M> && requires { M::step_parameter; },
        "a composition changes the step, which has to be a parameter of the model");

  public:
    using Scalar = typename M::Scalar;
    using Real = step_time_t<M>;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int dense_order = 0;

    template <class Method>
    explicit CompositionStepper(const Method&) noexcept
    {
    }

    /// Finds the arrows of the first step from (x, mu). What fails leaves `s` as it is.
    Status begin(const M& model, const Real& t, State& s) noexcept
    {
        here_ = Walk();
        const Status status = walk(model, t, Real(model.step()), s, here_);
        if (status == Status::ok) s = here_.state;
        return status;
    }

    /// `h` is the model's step: any other is invalid_input.
    Status attempt(const M& model, const Real& t, const State& s, const Real& h, State& s1) noexcept
    {
        const Real length(model.step());
        if (!detail::is_own_step(model, t, h)) return Status::invalid_input;
        if (s != here_.state) { // not where the last step led to
            here_ = Walk();
            const Status status = walk(model, t, length, s, here_);
            if (status != Status::ok) return status;
        }
        there_ = here_;
        const Status status = walk(model, t + length, length, here_.end, there_);
        if (status == Status::ok) s1 = there_.state;
        return status;
    }

    void accept() noexcept { here_ = there_; }
    /// Behind a step that failed.
    void forget() noexcept {}

    /// A discrete motion has no values inside of its steps.
    Status interpolate(const M&, const Real&, const State&, const Real&, const State&, const Real&, State& out) noexcept
    {
        out.setConstant(Scalar(std::numeric_limits<real_t<Scalar>>::quiet_NaN()));
        return Status::ok;
    }

    [[nodiscard]] std::size_t calls() const noexcept { return newton_iterations(); }
    [[nodiscard]] std::size_t newton_iterations() const noexcept { return forth_.evaluations() + back_.evaluations(); }
    [[nodiscard]] std::size_t decompositions() const noexcept
    {
        return forth_.decompositions() + back_.decompositions();
    }

  private:
    using Lanes = detail::ArrowLanes<M>;
    using Column = Eigen::Matrix<Scalar, Lanes::unknowns, 1>;
    static constexpr std::size_t steps = (Leapfrogs::weights.size() - 1) / 2;
    static_assert(Leapfrogs::kick_first && splitting::is_palindrome(Leapfrogs::weights));

    [[nodiscard]] static State nowhere() noexcept
    {
        return State::Constant(Scalar(std::numeric_limits<real_t<Scalar>>::quiet_NaN()));
    }

    /// The steps of a whole step: `state` is its state, and `end` the one behind its last arrow, with no arrow.
    struct Walk {
        State state = nowhere(), end = nowhere(), last = nowhere();
        Real last_length = Real(0);                   ///< of the arrow in `last`; 0: there is none
        bool knows_forth = false, knows_back = false; ///< the signs of det N
    };

    /// g_k
    [[nodiscard]] static Real share(std::size_t k) noexcept
    {
        return Leapfrogs::weights[2 * k + 1].template as<Real>();
    }

    /// The steps that begin at the point and the momenta of `from`, of the length h together.
    [[nodiscard]] Status walk(const M& model, const Real& t, const Real& h, const State& from, Walk& walk) noexcept
    {
        M part = model;
        walk.state = walk.end = from;
        clear_arrow(walk.state);
        Real done(0);
        for (std::size_t k = 0; k < steps; ++k) {
            const Real length = share(k) * h;
            part.parameter(M::step_parameter) = Scalar(length);
            const Scalar now(t + done);
            const Status status = find_arrow(part, now, length, walk);
            if (status != Status::ok) return status;
            append_arrow(walk.state, walk.last);
            Eigen::Matrix<Scalar, Lanes::n, 1> x;
            Eigen::Matrix<Scalar, Lanes::rank, 1> mu;
            part.forward(now, walk.last, x, mu);
            for (int i = 0; i < Lanes::n; ++i) walk.end[i] = x[i];
            for (int a = 0; a < Lanes::rank; ++a) walk.end[Lanes::momenta + a] = mu[a];
            done += length;
        }
        clear_arrow(walk.end);
        detail::renew_group_part(model, Scalar(t), walk.state);
        return walk.state.allFinite() && walk.end.allFinite() ? Status::ok : Status::non_finite;
    }

    /// Into `last`, from the arrow that stands there.
    [[nodiscard]] Status find_arrow(const M& part, const Scalar& t, const Real& length, Walk& walk) noexcept
    {
        State z = walk.end;
        clear_arrow(z);
        if (walk.last_length != Real(0)) scale_arrow(part, t, Scalar(length / walk.last_length), walk.last, z);
        bool& knows = length < Real(0) ? walk.knows_back : walk.knows_forth;
        const State guess = z;
        ArrowSolver<M>& solver = length < Real(0) ? back_ : forth_;
        const Status status = solver.solve(part, t, z, knows ? &guess : nullptr);
        if (status != Status::ok) return status;
        knows = true;
        walk.last = z;
        walk.last_length = length;
        return Status::ok;
    }

    static void clear_arrow(State& s) noexcept
    {
        for (int k = Lanes::next; k < Lanes::momenta; ++k) s[k] = Scalar(0);
    }

    /// The arrow of `last`, of `ratio` times its length, from the point of z.
    static void scale_arrow(const M& part, const Scalar& t, const Scalar& ratio, const State& last, State& z) noexcept
    {
        Column d = Column::Zero();
        if constexpr (Lanes::order > 0) {
            State here = z; // the coordinates of W do not depend on the point
            for (int k = Lanes::element; k < Lanes::within; ++k) here[k] = last[k];
            if constexpr (M::cayley) {
                d.template head<Lanes::rank>() = part.cayley_coordinates(t, here);
            } else {
                GroupMatrix<Scalar, Lanes::order> A;
                if (log_of_one_and<Scalar, Lanes::order>(detail::group_part<M>(here), A))
                    d.template head<Lanes::rank>() = part.in_algebra(A);
            }
            d *= ratio;
        }
        for (int k = 0; k < Lanes::inner; ++k) d[Lanes::rank + k] = ratio * last[Lanes::within + k];
        if (!d.allFinite() || !detail::move_arrow(part, t, z, d)) clear_arrow(z);
        for (int i = 0; i < Lanes::horizontal; ++i) z[Lanes::next + i] = ratio * last[Lanes::next + i];
    }

    /// s <- s g, of arrows that begin at points of their own.
    static void append_arrow(State& s, const State& g) noexcept
    {
        for (int i = 0; i < Lanes::horizontal; ++i) s[Lanes::next + i] += g[Lanes::next + i];
        if constexpr (Lanes::order > 0) {
            const auto V = detail::group_part<M>(s), W = detail::group_part<M>(g);
            detail::set_group_part<M>(s, V + W + V * W);
        }
    }

    ArrowSolver<M> forth_, back_; ///< det N has another sign where the step is negative
    Walk here_, there_;           ///< from the last accepted state, and from the attempted one
};

/// A composition of the steps of a discrete Lagrangian by the lengths of leapfrogs.
template <class Leapfrogs>
struct DiscreteComposition {
    template <class M>
    using Stepper = CompositionStepper<Leapfrogs, M>;
};

using Discrete4 = DiscreteComposition<splitting::Suzuki4>;
using Discrete6 = DiscreteComposition<splitting::KahanLi6>;
using Discrete8 = DiscreteComposition<splitting::KahanLi8>;

} // namespace lagen
