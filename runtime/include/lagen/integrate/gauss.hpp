// SPDX-License-Identifier: MIT
/// Gauss' collocation methods with a fixed step, `lagen::Gauss6{.step = 0.01}`, and Radau IIA of order 5 with a fixed
/// step. Gauss' methods are symplectic, symmetric and keep every quadratic invariant; Radau IIA damps what is stiff.
///
/// Every step solves its equations by Newton's method, with the Jacobian at the beginning of the step, until the
/// increments are rounding errors: what is kept is kept to rounding, and rounding errors are all that is left to add
/// up. A step whose iteration does not converge is tried once more with the Jacobian at an estimate of its middle, then
/// fails with `newton_diverged`. Where the method is `compensated`, the rounding error of the sum s1 = s + .. enters
/// the next step [Kahan 1965], so that errors grow as Brouwer's law says [Hairer, McLachlan, Razakarivony, BIT 48
/// (2008) 231].
/// A value inside a step is a shorter step of the same method, begun with this step's collocation polynomial: it has
/// the full order. Should Newton's method fail there, it is the value of the polynomial (order: the number of stages).
#pragma once

#include "lagen/integrate/stage_equations.hpp"

#include <limits>

namespace lagen {

/// The stepper of a collocation method: see integrate/march.hpp for what the march asks of it.
template <class Scheme, class M>
class CollocationStepper {
  public:
    using Real = typename M::Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int order = Scheme::order;
    static constexpr int dense_order = Scheme::order;
    static constexpr std::size_t stages = Scheme::stages;
    static constexpr int most_iterations = 50;

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
        scale_ = lost_;
        least_ = lost_;
        for (State& stage : z_) stage = lost_;
        inner_ = z_;
        return Status::ok;
    }

    Status attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        predict(h);
        h_ = h;
        equations_.linearise(model, t, s);
        Status status = equations_.factor(h) ? iterate(model, t, s, h, z_) : Status::newton_diverged;
        if (status != Status::ok) status = try_again(model, t, s, h);
        if (status != Status::ok) return status;
        for (Eigen::Index lane = 0; lane < s.size(); ++lane) {
            const Real increment = gain(z_, lane) - lost_[lane];
            s1[lane] = s[lane] + increment;
            next_lost_[lane] = (s1[lane] - s[lane]) - increment;
        }
        return detail::check_finite(s1);
    }

    void accept() noexcept
    {
        if (compensated_) lost_ = next_lost_;
        last_h_ = h_;
    }

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    Status interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        for (std::size_t i = 0; i < stages; ++i) along(Real(theta * equations_.method().c[i]), inner_[i]);
        const Real length = theta * h;
        if (equations_.factor(length) && iterate(model, t, s, length, inner_) == Status::ok) {
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

    /// Z(theta) of the last step's collocation polynomial.
    void along(const Real& theta, State& out) noexcept
    {
        detail::collocation_weights(equations_.method().c, theta, weights_);
        for (Eigen::Index lane = 0; lane < out.size(); ++lane) {
            Real sum = Real(0);
            for (std::size_t j = 0; j < stages; ++j) sum += weights_[j] * z_[j][lane];
            out[lane] = sum;
        }
    }

    /// The stages of a step of length h from the collocation polynomial of the step before; of the first step: s.
    void predict(const Real& h) noexcept
    {
        if (last_h_ == Real(0)) return;
        along(Real(1), next_lost_); // free until the step has converged
        for (std::size_t i = 0; i < stages; ++i) {
            along(Real(Real(1) + h / last_h_ * equations_.method().c[i]), inner_[i]);
            inner_[i] -= next_lost_;
        }
        z_ = inner_;
    }

    /// One step of Newton's method from the state itself solves the linearised equations; the mean of its stages is an
    /// estimate of the middle of the step. Where that step does not exist, Euler's stages are taken.
    Status try_again(const M& model, const Real& t, const State& s, const Real& h) noexcept
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
        next_lost_ = s;
        for (std::size_t i = 0; i < stages; ++i) next_lost_ += method.b[i] * z_[i];
        equations_.linearise(model, t + h / Real(2), next_lost_);
        return equations_.factor(h) ? iterate(model, t, s, h, z_) : Status::newton_diverged;
    }

    /// Newton's method from z until its increments are rounding errors: in every lane zero, or no longer decreasing.
    /// (To stop at two units of the last place of Z instead saves a tenth of the calls and lets invariants drift: what
    /// is left of Newton's method's error has a sign.) Increments that do not decrease while they are large have
    /// diverged.
    Status iterate(const M& model, const Real& t, const State& s, const Real& h, Stages& z) noexcept
    {
        equations_.row_sizes(s, scale_);
        for (Eigen::Index lane = 0; lane < s.size(); ++lane)
            scale_[lane] = detail::magnitude(s[lane]) + detail::magnitude(h) * scale_[lane];
        const Real noise = largest_noise();
        Real before = Real(0);
        for (int round = 0; round < most_iterations; ++round) {
            const Status status = equations_.evaluate(model, t, s, lost_, z);
            if (status != Status::ok) return status;
            equations_.solve();
            bool done = true;
            const Real size = move(z, round == 0, noise, done);
            if (size - size != Real(0)) return equations_.runaway();
            if (done && size <= noise) return Status::ok;
            if (round > 0 && size >= before && size > noise) return Status::newton_diverged;
            before = size;
        }
        return Status::newton_diverged;
    }

    /// z += increments; answers the largest one relative to what it is a rounding error of: |s| + |Z| + |h J| |s|.
    Real move(Stages& z, bool first, const Real& noise, bool& done) noexcept
    {
        Real largest = Real(0), bad = Real(0);
        for (Eigen::Index lane = 0; lane < scale_.size(); ++lane) {
            Real step = Real(0), reach = Real(0);
            for (std::size_t i = 0; i < stages; ++i) {
                const Real increment = equations_.residuals[i][lane];
                z[i][lane] += increment;
                const Real size = detail::magnitude(increment), all = detail::magnitude(z[i][lane]);
                bad += increment - increment;
                if (size > step) step = size;
                if (all > reach) reach = all;
            }
            const Real relative = step == Real(0) ? Real(0) : Real(step / (scale_[lane] + reach));
            // An iteration that gains less than a quarter a time would not end within the rounds that it has.
            if (first || Real(4) * step < Real(3) * least_[lane]) {
                least_[lane] = step;
                if (step != Real(0)) done = false;
            } else if (relative <= noise) {
                least_[lane] = Real(0); // at rest: nothing is smaller
            }
            if (relative > largest) largest = relative;
        }
        return largest + bad; // a NaN where an increment is not finite
    }

    detail::StageEquations<Scheme, M> equations_;
    Stages z_, inner_;
    State lost_, next_lost_, scale_, least_;
    std::array<Real, stages> weights_{};
    Real h_ = Real(0), last_h_ = Real(0);
    bool compensated_;
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
using Radau5Fixed = CollocationMethod<detail::RadauScheme>;

} // namespace lagen
