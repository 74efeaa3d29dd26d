// SPDX-License-Identifier: MIT
/// Radau IIA of order 5 with step control, for stiff problems: `lagen::Radau5{.tolerance = 1e-8}`. The algorithm is
/// that of Hairer's radau5.f [Hairer, Wanner IV.8]: simplified Newton iterations to a fraction of the tolerance, from
/// the collocation polynomial of the step before; Jacobian and decompositions kept while the iteration converges fast;
/// the embedded formula of order 3, filtered through (1 - h lambda J)^-1 with the real eigenvalue lambda; Gustafsson's
/// predictive control of the step. Dense output is the collocation polynomial, of order 3. Because the error estimated
/// is of order h^4 and the method's of order h^6, a tolerance q asks the estimate for 0.1 q^(2/3): that is so of the
/// larger one of the relative and the absolute tolerance, and the other one keeps its proportion to it.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/stage_equations.hpp"
#include "lagen/run.hpp"

#include <algorithm>
#include <limits>

namespace lagen {

namespace detail {

/// The lengths of the steps of Radau5: the elementary rule err^(-1/4), times a factor that falls with the number of
/// Newton iterations, and after an accepted step Gustafsson's prediction from the two last ones [Hairer, Wanner IV.8].
template <class Real>
class PredictiveControl {
  public:
    static constexpr int most_iterations = 7;

    explicit PredictiveControl(const StepControl& control) noexcept
        : safety_(static_cast<Real>(control.safety)), most_(Real(1) / static_cast<Real>(control.shrink)),
          least_(Real(1) / static_cast<Real>(control.grow))
    {
    }

    [[nodiscard]] Real after_accepted(const Real& h, const Real& error, int iterations, bool keeps_matrix) noexcept
    {
        Real quotient = elementary(error, iterations);
        if (accepted_) {
            const Real predicted = h_ / h * power_of_number<Real>(error * error / error_, Real(0.25)) / safety_;
            quotient = std::max<Real>(quotient, inside(predicted));
        }
        accepted_ = true;
        h_ = h;
        error_ = std::max<Real>(Real(0.01), error);
        if (rejected_) quotient = std::max<Real>(quotient, Real(1));
        rejected_ = false;
        const Real growth = Real(1) / quotient;
        return keeps_matrix && growth >= Real(1) && growth <= Real(1.2) ? h : Real(h * growth);
    }

    [[nodiscard]] Real after_rejected(const Real& h, const Real& error, int iterations) noexcept
    {
        rejected_ = true;
        return accepted_ ? Real(h / elementary(error, iterations)) : Real(h / Real(10));
    }

    /// After an iteration that did not converge: `share` of the step.
    [[nodiscard]] Real after_failure(const Real& h, const Real& share) noexcept
    {
        rejected_ = true;
        return share * h;
    }

    [[nodiscard]] bool is_careful() const noexcept { return rejected_ || !accepted_; }

  private:
    [[nodiscard]] Real inside(const Real& quotient) const noexcept
    {
        return quotient < least_ ? least_ : (quotient > most_ ? most_ : quotient);
    }

    [[nodiscard]] Real elementary(const Real& error, int iterations) const noexcept
    {
        const Real share = Real(1 + 2 * most_iterations) / Real(iterations + 2 * most_iterations);
        const Real factor = safety_ * std::min<Real>(Real(1), share);
        return inside(Real(power_of_number(error, Real(0.25)) / factor));
    }

    Real safety_, most_, least_;
    Real h_ = Real(0), error_ = Real(1);
    bool accepted_ = false, rejected_ = false;
};

} // namespace detail

/// See integrate/stepper.hpp for what is asked of a stepper.
template <class M>
class Radau5Stepper {
    using Scheme = detail::RadauScheme<3>;

  public:
    using Real = typename M::Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = true;
    static constexpr int order = 5;
    static constexpr int dense_order = 3;
    static constexpr int error_order = 4; ///< the error of the embedded formula is of this order in h
    static constexpr std::size_t stages = Scheme::stages;

    template <class Method>
    explicit Radau5Stepper(const Method& method) : control_(scaled(method.control())), lengths_(method.control())
    {
        using std::sqrt;
        const double larger = std::max(control_.relative_tolerance(), control_.absolute_tolerance());
        const Real tolerance = static_cast<Real>(larger), coarse = sqrt(tolerance);
        enough_ = std::max<Real>(Real(10) * epsilon() / tolerance, std::min<Real>(Real(0.03), coarse));
    }

    Status begin(const M& model, Real t, const State& s) noexcept
    {
        const Status begun = equations_.begin(model, s);
        if (begun != Status::ok) return begun;
        slope_ = State::Zero(s.size());
        next_slope_ = slope_;
        scale_ = slope_;
        e_ = slope_;
        none_ = slope_;
        for (State& stage : z_) stage = slope_;
        last_z_ = z_;
        ++equations_.calls;
        const Status status = model.rhs(t, s, slope_);
        return status == Status::ok ? detail::check_finite(slope_) : status;
    }

    [[nodiscard]] Real first_step(const M& model, Real t, Real length, const State& s) noexcept
    {
        ++equations_.calls;
        return detail::first_step(model, control_, error_order - 1, t, length, s, slope_, e_, next_slope_);
    }

    /// s1 = X_3 and its scaled error.
    Status attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        share_ = Real(0.5);
        set_scale(s);
        if (!has_matrix(model, t, s, h)) return Status::newton_diverged;
        predict(h);
        const Status status = iterate(model, t, s);
        if (status != Status::ok) return fail(status);
        s1 = s + z_.back();
        const Status finite = detail::check_finite(s1);
        if (finite != Status::ok) return fail(finite);
        return estimate(model, t, s, h);
    }

    [[nodiscard]] Real error() const noexcept { return error_; }

    /// The derivative at the end, which the next error estimate needs.
    Status finish(const M& model, Real t1, const State& s1) noexcept
    {
        ++equations_.calls;
        const Status status = model.rhs(t1, s1, next_slope_);
        return status == Status::ok ? detail::check_finite(next_slope_) : status;
    }

    void accept() noexcept
    {
        slope_ = next_slope_;
        last_z_ = z_;
        last_h_ = h_;
        jacobian_is_here_ = false;
    }

    [[nodiscard]] const State& derivative() const noexcept { return slope_; }

    /// The collocation polynomial; asks nothing of the model.
    Status interpolate(const M&, Real, const State& s, Real, const State&, Real theta, State& out) noexcept
    {
        along(z_, theta, out);
        out += s;
        return detail::check_finite(out);
    }

    // ---- lengths: the march asks these instead of its own controller ----

    [[nodiscard]] Real after_accepted(Real h, Real error) noexcept
    {
        return lengths_.after_accepted(h, error, iterations_, rate_ <= fast);
    }
    [[nodiscard]] Real after_rejected(Real h, Real error) noexcept
    {
        keeps_jacobian_ = false;
        return lengths_.after_rejected(h, error, iterations_);
    }
    [[nodiscard]] Real after_failure(Real h) noexcept { return lengths_.after_failure(h, share_); }

    [[nodiscard]] std::size_t calls() const noexcept { return equations_.calls; }
    [[nodiscard]] std::size_t newton_iterations() const noexcept { return equations_.iterations; }
    [[nodiscard]] std::size_t decompositions() const noexcept { return equations_.decompositions; }

  private:
    using Stages = std::array<State, stages>;
    using Lengths = detail::PredictiveControl<Real>;
    static constexpr double fast = 0.001; ///< a rate of convergence at which Jacobian and decompositions are kept
    static Real epsilon() noexcept { return std::numeric_limits<Real>::epsilon(); }

    /// The tolerances of the estimate: those given, times 0.1 q^(-1/3) with the larger one, q. (In radau5.f q is the
    /// relative one: a small one beside an absolute one would then loosen the latter, in the limit without a bound.)
    static StepControl scaled(StepControl control) noexcept
    {
        const double relative = control.relative_tolerance(), absolute = control.absolute_tolerance();
        const double larger = std::max(relative, absolute);
        if (!(larger > 0)) return control;
        const double estimate = 0.1 * std::pow(larger, 2.0 / 3.0);
        control.relative = estimate * (relative / larger);
        control.absolute = estimate * (absolute / larger);
        return control;
    }

    void set_scale(const State& s) noexcept
    {
        const Real rtol = static_cast<Real>(control_.relative_tolerance());
        const Real atol = static_cast<Real>(control_.absolute_tolerance());
        for (Eigen::Index lane = 0; lane < s.size(); ++lane) scale_[lane] = atol + rtol * detail::magnitude(s[lane]);
    }

    /// Without an absolute tolerance a lane at rest at 0 has no size but that of its stages.
    void widen_scale() noexcept
    {
        if (control_.absolute_tolerance() > 0) return;
        const Real rtol = static_cast<Real>(control_.relative_tolerance());
        for (Eigen::Index lane = 0; lane < scale_.size(); ++lane) {
            Real reach = std::numeric_limits<Real>::min(); // no scale is 0, whatever underflows
            for (std::size_t i = 0; i < stages; ++i) {
                const Real size = detail::magnitude(z_[i][lane]) + detail::magnitude(equations_.residuals[i][lane]);
                reach = std::max<Real>(reach, rtol * size);
            }
            scale_[lane] = std::max<Real>(scale_[lane], reach);
        }
    }

    /// Sum of the squares of e in units of the tolerances; where there is no error, a tolerance of zero is met.
    [[nodiscard]] Real square(const State& e) const noexcept
    {
        Real sum = Real(0);
        for (Eigen::Index lane = 0; lane < e.size(); ++lane) {
            if (e[lane] == Real(0)) continue;
            const Real ratio = e[lane] / scale_[lane];
            sum += ratio * ratio;
        }
        return sum;
    }

    bool has_matrix(const M& model, const Real& t, const State& s, const Real& h) noexcept
    {
        if (!jacobian_is_here_ && !keeps_jacobian_) {
            equations_.linearise(model, t, s);
            jacobian_is_here_ = true;
            factored_h_ = Real(0);
        }
        if (factored_h_ == h) return true;
        factored_h_ = h;
        if (equations_.factor(h)) return true;
        keeps_jacobian_ = false;
        factored_h_ = Real(0);
        return false;
    }

    void along(const Stages& z, const Real& theta, State& out) noexcept
    {
        detail::collocation_weights(equations_.method().c, theta, weights_);
        for (Eigen::Index lane = 0; lane < out.size(); ++lane) {
            Real sum = Real(0);
            for (std::size_t j = 0; j < stages; ++j) sum += weights_[j] * z[j][lane];
            out[lane] = sum;
        }
    }

    /// The stages from the last accepted step's collocation polynomial, whose value at its end is Z_3.
    void predict(const Real& h) noexcept
    {
        h_ = h;
        for (std::size_t i = 0; i < stages; ++i) {
            if (last_h_ == Real(0)) {
                z_[i].setZero();
                continue;
            }
            along(last_z_, Real(Real(1) + h / last_h_ * equations_.method().c[i]), z_[i]);
            z_[i] -= last_z_.back();
        }
    }

    Status fail(Status status) noexcept
    {
        keeps_jacobian_ = false;
        return status;
    }

    /// Simplified Newton iterations until what is left of the error is `enough_` of the tolerance.
    Status iterate(const M& model, const Real& t, const State& s) noexcept
    {
        using std::sqrt;
        const auto lanes = static_cast<Real>(stages * static_cast<std::size_t>(s.size() > 0 ? s.size() : 1));
        left_ = detail::power_of_number(std::max<Real>(left_, epsilon()), Real(0.8));
        rate_ = Real(fast);
        Real before = Real(0), rate_before = Real(0);
        for (iterations_ = 1; iterations_ <= Lengths::most_iterations; ++iterations_) {
            const Status status = equations_.evaluate(model, t, s, none_, z_);
            if (status != Status::ok) return status;
            equations_.solve();
            widen_scale();
            const Real size = sqrt(Real(equations_.squared_increments(scale_) / lanes));
            if (size - size != Real(0)) return equations_.runaway();
            if (iterations_ > 1 && iterations_ < Lengths::most_iterations) {
                const Real ratio = size / before;
                rate_ = iterations_ == 2 ? ratio : sqrt(Real(ratio * rate_before));
                rate_before = ratio;
                if (!is_converging(size)) return Status::newton_diverged;
            }
            before = std::max<Real>(size, epsilon());
            for (std::size_t i = 0; i < stages; ++i) z_[i] += equations_.residuals[i];
            if (left_ * size <= enough_) {
                keeps_jacobian_ = rate_ <= Real(fast);
                return Status::ok;
            }
        }
        iterations_ = Lengths::most_iterations;
        return Status::newton_diverged;
    }

    /// False where the iteration diverges or would need too many steps; sets the share of the step to go on with.
    bool is_converging(const Real& size) noexcept
    {
        if (!(rate_ < Real(0.99))) return false;
        left_ = rate_ / (Real(1) - rate_);
        const int rest = Lengths::most_iterations - 1 - iterations_;
        const Real at_end = left_ * size * detail::power_of_number(rate_, Real(rest)) / enough_;
        if (at_end < Real(1)) return true;
        const Real excess = std::max<Real>(Real(1e-4), std::min<Real>(Real(20), at_end));
        share_ = Real(0.8) * detail::power_of_number<Real>(excess, Real(-1) / Real(4 + rest));
        return false;
    }

    /// The embedded formula's error, lambda (1 - h lambda J)^-1 (h f(t, s) + sum_i e_i Z_i), and where it is too
    /// large for a first or repeated step once more with f at s + that error [Hairer, Wanner IV.8, (8.19), (8.20)].
    Status estimate(const M& model, const Real& t, const State& s, const Real& h) noexcept
    {
        measure(h, slope_);
        if (error_ < Real(1) || !lengths_.is_careful()) return Status::ok;
        e_ += s;
        ++equations_.calls;
        if (model.rhs(t, e_, next_slope_) == Status::ok) measure(h, next_slope_);
        return Status::ok;
    }

    void measure(const Real& h, const State& slope) noexcept
    {
        using std::sqrt;
        const Real root = Real(7) * sqrt(Real(6));
        const Real e1 = (Real(-13) - root) / Real(3), e2 = (root - Real(13)) / Real(3), e3 = Real(-1) / Real(3);
        const Real weight = equations_.real_eigenvalue();
        for (Eigen::Index lane = 0; lane < e_.size(); ++lane)
            e_[lane] = weight * (h * slope[lane] + e1 * z_[0][lane] + e2 * z_[1][lane] + e3 * z_[2][lane]);
        equations_.solve_real(e_);
        error_ = std::max<Real>(Real(1e-10), sqrt(Real(square(e_) / static_cast<Real>(e_.size()))));
    }

    detail::StageEquations<Scheme, M> equations_;
    StepControl control_;
    Lengths lengths_;
    Stages z_, last_z_;
    State slope_, next_slope_, scale_, e_, none_;
    std::array<Real, stages> weights_{};
    Real enough_ = Real(0);  ///< of the tolerance, for Newton's method
    Real left_ = Real(1);    ///< rate / (1 - rate): the error that is left, relative to the last increment
    Real rate_ = Real(1);    ///< of convergence
    Real share_ = Real(0.5); ///< of a step that failed, to go on with
    Real error_ = Real(0);
    Real h_ = Real(0), last_h_ = Real(0), factored_h_ = Real(0);
    int iterations_ = 0;
    bool jacobian_is_here_ = false, keeps_jacobian_ = false;
};

namespace detail {

struct Radau5Family {
    static constexpr StepControl defaults{.grow = 8};
    template <class M>
    using Stepper = Radau5Stepper<M>;
};

} // namespace detail

/// Radau IIA with step control: see AdaptiveMethod; `beta` has no use here.
using Radau5 = AdaptiveMethod<detail::Radau5Family>;

} // namespace lagen
