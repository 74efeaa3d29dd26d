// SPDX-License-Identifier: MIT
/// Gauss' collocation methods with a fixed step, `lagen::Gauss6{.step = 0.01}`, and Radau IIA of orders 3 and 5 with
/// a fixed step. Gauss' methods are symplectic, symmetric and keep every quadratic invariant; Radau IIA damps what is
/// stiff.
///
/// Every step solves its equations by Newton's method, with the Jacobian at the beginning of the step, until the
/// increments are rounding errors: what is kept is kept to rounding, and rounding errors are all that is left to add
/// up. An iteration that converges slowly gets the Jacobian at an estimate of the step's middle; a step whose iteration
/// does not converge is tried once more from there, then fails with `newton_diverged`. Where the method is
/// `compensated`, the rounding error of the sum s1 = s + .. enters the next step [Kahan 1965], so that errors grow as
/// Brouwer's law says [Hairer, McLachlan, Razakarivony, BIT 48 (2008) 231]. A value inside a step is a shorter step of
/// the same method, begun with this step's collocation polynomial: it has the full order. Should Newton's method fail
/// there, it is the value of the polynomial (order: the number of stages).
#pragma once

#include "lagen/integrate/stage_equations.hpp"

#include <limits>

namespace lagen {

/// The stepper of a collocation method: see integrate/integrator.hpp for what is asked of it.
template <class Scheme, class M>
class CollocationStepper {
  public:
    using Real = typename M::Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int order = Scheme::order;
    static constexpr int dense_order = Scheme::order;
    static constexpr std::size_t stages = Scheme::stages;
    static constexpr int most_iterations = 100;
    static constexpr int most_refreshments = 5; ///< of the Jacobian in a step

    template <class Method>
    explicit CollocationStepper(const Method& method) : compensated_(method.compensated)
    {
    }

    /// No derivative is kept from step to step; the first step begins without a prediction.
    Status begin(const M&, Real, const State& s) noexcept
    {
        equations_.begin(s);
        lost_ = State::Zero(s.size());
        next_lost_ = lost_;
        middle_ = lost_;
        scale_ = lost_;
        least_ = lost_;
        rounds_ = lost_;
        steps_ = lost_;
        relative_ = lost_;
        for (State& stage : z_) stage = lost_;
        inner_ = z_;
        return Status::ok;
    }

    Status attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        predict(h);
        h_ = h;
        Status status = try_from(model, t, s, h, most_refreshments);
        if (status != Status::ok) {
            // Rarely, a Jacobian that stays as it is leads to stages that better ones lead away from.
            for (State& stage : z_) stage.setZero();
            status = try_from(model, t, s, h, 0);
        }
        if (status != Status::ok) return status;
        detail::for_each_lane(s, [&](Eigen::Index lane) {
            const Real increment = gain(z_, lane) - lost_[lane];
            s1[lane] = s[lane] + increment;
            next_lost_[lane] = (s1[lane] - s[lane]) - increment;
        });
        return detail::check_finite(s1);
    }

    void accept() noexcept
    {
        if (compensated_) lost_ = next_lost_;
        last_h_ = h_;
    }

    /// After a step that failed: its stages predict nothing.
    void forget() noexcept
    {
        last_h_ = Real(0);
        for (State& stage : z_) stage.setZero();
    }

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    Status interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        for (std::size_t i = 0; i < stages; ++i) along(Real(theta * equations_.method().c[i]), inner_[i]);
        const Real length = theta * h;
        if (equations_.factor(length) && iterate(model, t, s, length, inner_, most_refreshments) == Status::ok) {
            for (Eigen::Index lane = 0; lane < s.size(); ++lane)
                out[lane] = s[lane] + (gain(inner_, lane) - lost_[lane]);
        } else {
            along(theta, out);
            out += s;
        }
        return detail::check_finite(out);
    }

    [[nodiscard]] std::size_t calls() const noexcept { return equations_.calls; }
    [[nodiscard]] std::size_t newton_iterations() const noexcept { return equations_.iterations; }
    [[nodiscard]] std::size_t decompositions() const noexcept { return equations_.decompositions; }

  private:
    using Stages = std::array<State, stages>;
    static Real epsilon() noexcept { return std::numeric_limits<Real>::epsilon(); }
    static Real rounding() noexcept { return Real(2) * epsilon(); }
    /// A Jacobian with which increments fall by less is replaced.
    static Real slow_rate() noexcept { return Real(0.5); }
    /// epsilon^(5/8), 1.6e-10 in double: increments that stop decreasing below this size are taken for rounding errors
    /// of a right-hand side that is not computed to the last place.
    static Real largest_noise() noexcept
    {
        using std::sqrt;
        const Real half = sqrt(epsilon());
        const Real quarter = sqrt(half);
        return half * sqrt(quarter);
    }

    /// s1 - s of a lane, of stages that have converged.
    Real gain(const Stages& z, Eigen::Index lane) const noexcept
    {
        // Slopes of stiff problems carry the rounding errors of the stages times the Jacobian.
        if constexpr (Scheme::stiffly_accurate) return z.back()[lane];
        Real sum = equations_.slopes[0][lane];
        for (std::size_t j = 1; j < stages; ++j) sum += equations_.slopes[j][lane];
        return equations_.times_length(sum);
    }

    using Weights = std::array<Real, stages>;

    /// The sum of weights times the stages of the last step.
    void combine(const Weights& weights, State& out) const noexcept
    {
        detail::for_each_lane(out, [&](Eigen::Index lane) {
            Real sum = weights[0] * z_[0][lane];
            for (std::size_t j = 1; j < stages; ++j) sum += weights[j] * z_[j][lane];
            out[lane] = sum;
        });
    }

    /// Z(theta) of the last step's collocation polynomial.
    void along(const Real& theta, State& out) noexcept
    {
        Weights weights;
        detail::collocation_weights(equations_.method().c, theta, weights);
        combine(weights, out);
    }

    /// The stages of a step of length h from the collocation polynomial of the step before; of the first step: s.
    void predict(const Real& h) noexcept
    {
        if (last_h_ == Real(0)) return;
        const auto& c = equations_.method().c;
        if (const Real ratio = h / last_h_; ratio != ratio_) {
            ratio_ = ratio;
            detail::collocation_weights(c, Real(1), at_end_);
            for (std::size_t i = 0; i < stages; ++i)
                detail::collocation_weights(c, Real(Real(1) + ratio * c[i]), ahead_[i]);
        }
        combine(at_end_, middle_);
        for (std::size_t i = 0; i < stages; ++i) {
            combine(ahead_[i], inner_[i]);
            inner_[i] -= middle_;
        }
        z_ = inner_;
    }

    /// Newton's method from z_ with the Jacobian at the beginning of the step, then, where it fails, once more.
    Status try_from(const M& model, const Real& t, const State& s, const Real& h, int refreshments) noexcept
    {
        equations_.linearise(model, t, s);
        if (equations_.factor(h) && iterate(model, t, s, h, z_, refreshments) == Status::ok) return Status::ok;
        return try_again(model, t, s, h, refreshments);
    }

    /// One step of Newton's method from the state itself solves the linearised equations; the mean of its stages is an
    /// estimate of the middle of the step. Where that step does not exist, Euler's stages are taken.
    Status try_again(const M& model, const Real& t, const State& s, const Real& h, int refreshments) noexcept
    {
        const auto& method = equations_.method();
        for (State& stage : z_) stage.setZero();
        const Status status = equations_.evaluate(model, t, s, lost_, z_);
        if (status != Status::ok) return status;
        inner_ = equations_.slopes;
        if (equations_.factor(h)) {
            equations_.solve();
            z_ = equations_.residuals;
        } else {
            for (std::size_t i = 0; i < stages; ++i) z_[i] = (h * method.c[i] / method.b[i]) * inner_[i];
        }
        return linearise_middle(model, t, s, h, z_) ? iterate(model, t, s, h, z_, refreshments)
                                                    : Status::newton_diverged;
    }

    /// Newton's method from z until the increments of every lane are rounding errors (see `move`). One that converges
    /// slowly gets the Jacobian at an estimate of the middle of the step from where it is; increments that do not
    /// decrease while they are large have diverged.
    Status iterate(const M& model, const Real& t, const State& s, const Real& h, Stages& z, int refreshments) noexcept
    {
        measure(s, h);
        least_.setConstant(std::numeric_limits<Real>::max());
        rounds_.setZero();
        const Real noise = noise_;
        Real before = Real(0), least = Real(0);
        int rounds = 0;      // since the largest increment reached a new minimum
        bool judged = false; // the increments of two Jacobians are not compared
        fast_ = true;
        for (int round = 0; round < most_iterations; ++round) {
            const Status status = equations_.evaluate(model, t, s, lost_, z);
            if (status != Status::ok) return status;
            equations_.solve();
            const Real size = move(z);
            if (size - size != Real(0)) return equations_.runaway();
            bool rests = false, wanders = false;
            if (size <= noise) judge(noise, rests, wanders);
            remember();
            rounds = round == 0 || size < least ? 0 : rounds + 1;
            if (rounds == 0) least = size;
            if (rests || (wanders && rounds >= 2)) return Status::ok;
            if (judged && size >= before && size > noise) return Status::newton_diverged;
            if (judged && size > Real(4) * rounding()) fast_ = size <= slow_rate() * before;
            const bool slow = judged && !fast_ && size > noise;
            before = size;
            judged = !slow || refreshments <= 0;
            if (!slow || refreshments-- <= 0) continue;
            if (!linearise_middle(model, t, s, h, z)) return Status::newton_diverged;
            measure(s, h);
        }
        return Status::newton_diverged;
    }

    /// scale_ = |s| + |h J| |s|: what increments are rounding errors of, but for |Z|.
    void measure(const State& s, const Real& h) noexcept
    {
        equations_.row_sizes(s, scale_);
        detail::for_each_lane(s, [&](Eigen::Index lane) {
            scale_[lane] = detail::magnitude(s[lane]) + detail::magnitude(h) * scale_[lane];
        });
    }

    /// The Jacobian at s + sum_j b_j Z_j; false where it cannot be decomposed.
    bool linearise_middle(const M& model, const Real& t, const State& s, const Real& h, const Stages& z) noexcept
    {
        middle_ = s;
        for (std::size_t i = 0; i < stages; ++i) middle_ += equations_.method().b[i] * z[i];
        equations_.linearise(model, t + h / Real(2), middle_);
        return equations_.factor(h);
    }

    /// z += increments; answers the largest one relative to what it is a rounding error of: |s| + |Z| + |h J| |s|. No
    /// number where an increment is none.
    Real move(Stages& z) noexcept
    {
        using detail::load;
        using detail::size_of;
        Real largest = Real(0), sum = Real(0);
        detail::for_lanes(scale_, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            using Slice = detail::Slice<State, width>;
            Slice step = detail::uniform<State, width>(Real(0)), reach = step, all = step;
            detail::write_out<stages>([&](auto i) {
                const Slice increment = load<width>(equations_.residuals[i], lane);
                const Slice moved = load<width>(z[i], lane) + increment;
                detail::store(z[i], lane, moved);
                const Slice size = size_of(increment), far = size_of(moved);
                step = size > step ? size : step;
                reach = far > reach ? far : reach;
                all += increment;
            });
            // Where everything is zero the quotient is, too.
            const Slice least = detail::uniform<State, width>(std::numeric_limits<Real>::min());
            const Slice relative = step / (load<width>(scale_, lane) + reach + least);
            detail::store(steps_, lane, step);
            detail::store(relative_, lane, relative);
            sum += detail::total(all);
            largest = std::max<Real>(largest, detail::largest(relative));
        });
        return largest + (sum - sum);
    }

    /// After `move`, of all increments (of a lane the largest of its stages):
    ///   `rests` says that they are zero, or a few units of the last place and fell by less than a quarter after a fast
    ///     convergence. (To stop at two units instead saves a tenth of the calls and lets invariants drift: what is
    ///     left of Newton's method's error has a sign.)
    ///   `wanders` says that they do so, or are below `noise` and reached no new minimum for two rounds: after a slow
    ///     convergence, or with a right-hand side that is not computed to the last place. An oscillation comes close to
    ///     zero in one lane or another: the largest increment has to stand still as well.
    void judge(const Real& noise, bool& rests, bool& wanders) const noexcept
    {
        rests = wanders = true;
        detail::for_each_lane(scale_, [&](Eigen::Index lane) {
            const bool small = steps_[lane] == Real(0) || (relative_[lane] <= rounding() && fast_ &&
                                                           !(Real(4) * steps_[lane] < Real(3) * least_[lane]));
            const bool stands = steps_[lane] >= least_[lane] && rounds_[lane] >= Real(1);
            rests = rests && small;
            wanders = wanders && (small || (stands && relative_[lane] <= noise));
        });
    }

    /// Keeps the least increment of every lane, and for how many rounds there has been no new one.
    void remember() noexcept
    {
        detail::for_lanes(scale_, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            using Slice = detail::Slice<State, width>;
            const Slice step = detail::load<width>(steps_, lane), least = detail::load<width>(least_, lane);
            const Slice more = detail::load<width>(rounds_, lane) + Real(1);
            detail::store(rounds_, lane, step < least ? detail::uniform<State, width>(Real(0)) : more);
            detail::store(least_, lane, step < least ? step : least);
        });
    }

    detail::StageEquations<Scheme, M> equations_;
    Stages z_, inner_;
    State lost_, next_lost_; ///< of the sum, before and behind a step that converged; values inside it leave them alone
    State middle_, scale_, steps_, relative_, least_, rounds_;
    Real noise_ = largest_noise();
    Weights at_end_{};                    ///< of the stages, in Z(1)
    std::array<Weights, stages> ahead_{}; ///< and in the next step's stages, h / last_h_ being ratio_
    Real h_ = Real(0), last_h_ = Real(0), ratio_ = Real(0);
    bool compensated_;
    bool fast_ = true; ///< the increments of this iteration fall well
};

/// A collocation method with a fixed positive `step`; `compensated` carries the rounding errors of the sums along.
template <class Scheme>
struct CollocationMethod {
    double step = 0;
    bool compensated = true;

    template <class M>
    using Stepper = CollocationStepper<Scheme, M>;
};

using Gauss2 = CollocationMethod<detail::GaussScheme<1>>; ///< the implicit midpoint rule
using Gauss4 = CollocationMethod<detail::GaussScheme<2>>;
using Gauss6 = CollocationMethod<detail::GaussScheme<3>>;
using Gauss8 = CollocationMethod<detail::GaussScheme<4>>;
using Radau3Fixed = CollocationMethod<detail::RadauScheme<2>>;
using Radau5Fixed = CollocationMethod<detail::RadauScheme<3>>;

} // namespace lagen
