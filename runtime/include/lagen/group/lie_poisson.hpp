// SPDX-License-Identifier: MIT
/// Poisson maps for Lie-Poisson systems, s' = ad*_xi s with xi = dH(s): Hamilton's form of a model on a Lie algebra, or
/// of one on M x g where g acts linearly on M, whose (x, mu) lie in the dual of a semidirect sum.
///   LiePoisson2{.step = h}            m = mean of exp(tau h ad*_xi) s over 0 < tau < 1,  xi = dH(t + h/2, m),
///                                     s1 = exp(h ad*_xi) s
///   LiePoisson4{.step = h}            five such steps, of lengths g, g, 1 - 4 g, g, g, g = 1/(4 - 4^(1/3)) [Suzuki
///   1990]
/// The step is that of the discrete action sum_k <m, log(g_k^-1 g_k+1)> - h H(m) [Bou-Rabee, Marsden, Foundations of
/// Computational Mathematics 9 (2009) 197], and symmetric. It keeps Casimirs to rounding, and the energy error stays
/// bounded; matrices that are reconstructed beside it move by the same exponentials.
#pragma once

#include "lagen/group/algebra_action.hpp"
#include "lagen/integrate/convergence.hpp"
#include "lagen/run.hpp"

#include <cmath>

namespace lagen {

/// The stepper: see integrate/stepper.hpp for what is asked of it.
template <int order_of_step, class M>
class LiePoissonStepper {
    static_assert(!is_pack<typename M::Scalar>, "methods on groups take one trajectory at a time");
    static_assert(detail::free_lanes<M>.empty(),
                  "Lie-Poisson methods take Hamilton's form without forces and first-order states");
    static_assert(order_of_step == 2 || order_of_step == 4);

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int order = order_of_step;
    static constexpr int dense_order = order_of_step;

    template <class Method>
    explicit LiePoissonStepper(const Method&) noexcept
    {
    }

    Status begin(const M&, const Real&, const State& s) noexcept
    {
        lost_ = next_lost_ = State::Zero(s.size());
        convergence_.begin(lost_);
        return Status::ok;
    }

    Status attempt(const M& model, const Real& t, const State& s, const Real& h, State& s1) noexcept
    {
        return move(model, t, s, h, s1, next_lost_);
    }

    void accept() noexcept { lost_ = next_lost_; }

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    Status interpolate(const M& model, const Real& t, const State& s, const Real& h, const State&, const Real& theta,
                       State& out) noexcept
    {
        State ignored;
        return move(model, t, s, Real(theta * h), out, ignored);
    }

    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

  private:
    Status move(const M& model, const Real& t, const State& s, const Real& h, State& s1, State& lost) noexcept
    {
        lost = lost_;
        s1 = s;
        if constexpr (order == 2) return step(model, t, h, s1, lost);
        using std::pow;
        const Real g = Real(1) / (Real(4) - pow(Real(4), Real(1) / Real(3))), outer = g * h,
                   inner = h - Real(4) * outer;
        Real clock = t;
        for (const Real& length : {outer, outer, inner, outer, outer}) {
            const Status status = step(model, clock, length, s1, lost);
            if (status != Status::ok) return status;
            clock += length;
        }
        return Status::ok;
    }

    /// Moves s, the sums for which begin with -lost.
    Status step(const M& model, const Real& t, const Real& h, State& s, State& lost) noexcept
    {
        using Verdict = typename detail::Convergence<State>::Verdict;
        constexpr int most_iterations = 100;
        const Real middle = t + h / Real(2);
        AlgebraElement<M> xi;
        State mean = State::Zero(s.size()), next;
        convergence_.scale = s.cwiseAbs();
        convergence_.start();
        Verdict verdict = Verdict::goes_on;
        for (int k = 0; k < most_iterations && verdict != Verdict::done; ++k) {
            ++calls_;
            const Status status = model.algebra_element(middle, State(s + mean), xi);
            if (status != Status::ok) return status;
            xi *= h;
            detail::add_motion<true>(model, middle, s, xi, next);
            verdict = compare(next, mean);
            mean = next;
            if (!next.allFinite()) return Status::newton_diverged;
            if (verdict == Verdict::diverged)
                convergence_.renew(); // the increments of a lane that begins at 0 may grow
        }
        if (verdict != Verdict::done) return Status::newton_diverged;
        State increment;
        detail::add_motion<false>(model, middle, s, xi, increment);
        increment -= lost;
        const State s1 = s + increment;
        lost = (s1 - s) - increment;
        s = s1;
        return detail::check_finite(s);
    }

    typename detail::Convergence<State>::Verdict compare(const State& next, const State& mean) noexcept
    {
        Real largest(0);
        for (Eigen::Index k = 0; k < next.size(); ++k) {
            const Real step = detail::size_of(Real(next[k] - mean[k])), reach = detail::size_of(next[k]);
            largest = std::max<Real>(largest, convergence_.template note<1>(k, step, reach));
        }
        return convergence_.judge(largest);
    }

    State lost_, next_lost_; ///< of the sums, before and behind a step
    detail::Convergence<State> convergence_;
    std::size_t calls_ = 0;
};

/// A Lie-Poisson method with a fixed `step`.
template <int order>
struct LiePoissonMethod {
    double step = 0;

    template <class M>
    using Stepper = LiePoissonStepper<order, M>;
};

using LiePoisson2 = LiePoissonMethod<2>;
using LiePoisson4 = LiePoissonMethod<4>;

} // namespace lagen
