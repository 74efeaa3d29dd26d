// SPDX-License-Identifier: MIT
/// Steps of different length that leave long runs what a symmetric method of fixed step gives them:
/// `lagen::Reversible<lagen::LeapfrogKdk>{.step = 0.05}`. A step has the length epsilon / rho with epsilon = `step`,
/// and rho, the density of steps, follows the inverse of a time scale sigma of the state through its rate alone,
///   rho_(n+1/2) = rho_(n-1/2) + epsilon G(s_n),   G = -sigma' / sigma,   rho_(1/2) = 1/sigma(s_0) + epsilon G(s_0)/2
/// [E. Hairer, G. Soederlind, SIAM Journal on Scientific Computing 26 (2005) 1838]. The map of s and rho is reversible:
/// energies of eccentric orbits do not drift, as they do where a step's length is a function of its beginning.
///
/// The model names the time scale (`HasTimeScale`), as r^(3/2) of Kepler's problem.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/splittings.hpp"

namespace lagen {

/// time_scale(t, s) is (sigma, d sigma/dt along the motion), sigma > 0.
template <class M>
concept HasTimeScale = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    requires std::convertible_to<decltype(model.time_scale(t, s)[0]), typename M::Scalar>;
};

/// The stepper: see integrate/integrator.hpp for what is asked of it. A step that could not be evaluated is tried with
/// half its length, and rho follows it; only there, and where an end cuts a step short, is the map not reversible.
template <class Method, class M>
class ReversibleStepper {
    static_assert(HasTimeScale<M>, "a reversible choice of steps needs M::time_scale(t, s)");
    static_assert(!is_pack<typename M::Scalar>, "the lanes of a pack have one step: use a fixed one");

  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    using Base = typename Method::template Stepper<M>;
    static constexpr bool adaptive = true;
    static constexpr bool foresees = true;
    static constexpr int order = Base::order;
    static constexpr int dense_order = Base::dense_order;

    template <class Given>
    explicit ReversibleStepper(const Given& method) noexcept
        : base_(method.base()), epsilon_(static_cast<Real>(method.step))
    {
    }

    Status begin(const M& model, Real t, const State& s) noexcept
    {
        const Status status = base_.begin(model, t, s);
        from_ = s;
        rates_ = State::Zero(s.size());
        const Real sigma = scale(model, t, s);
        return status == Status::ok && !(sigma > Real(0)) ? Status::non_finite : status;
    }

    /// epsilon / rho_(1/2).
    [[nodiscard]] Real first_step(const M& model, Real t, const Real& most, const State& s) noexcept
    {
        const Real sigma = scale(model, t, s);
        if ((most < Real(0)) != (epsilon_ < Real(0))) epsilon_ = -epsilon_;
        density_ = Real(1) / sigma + epsilon_ * growth_ / Real(2);
        return detail::size_of(Real(epsilon_ / density_));
    }

    Status attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        if (!(density_ > Real(0))) return Status::step_too_small; // the time scale changes too much in the first step
        from_ = s;
        length_ = h;
        return base_.attempt(model, t, s, h, s1);
    }

    /// The rate of rho at the end. step_too_small where rho would not stay positive.
    Status finish(const M& model, Real t1, const State& s1) noexcept
    {
        (void)scale(model, t1, s1);
        rates_ = (s1 - from_) / Scalar(length_);
        next_ = density_ + density_ * length_ * growth_;
        if (!(next_ - next_ == Real(0))) return Status::non_finite;
        return next_ > Real(0) ? Status::ok : Status::step_too_small;
    }

    void accept() noexcept { base_.accept(); }

    Status interpolate(const M& model, Real t, const State& s, Real h, const State& s1, Real theta, State& out) noexcept
    {
        return base_.interpolate(model, t, s, h, s1, theta, out);
    }

    [[nodiscard]] Real error() const noexcept { return Real(0); }
    [[nodiscard]] Real after_accepted(const Real&, const Real&) noexcept
    {
        density_ = next_;
        return detail::size_of(Real(epsilon_ / density_));
    }
    [[nodiscard]] Real after_rejected(const Real& h, const Real&) const noexcept { return h / Real(2); }
    [[nodiscard]] Real after_failure(const Real& h) const noexcept { return h / Real(2); }
    /// Of the last step, on the average: where the next one goes.
    [[nodiscard]] const State& derivative() const noexcept { return rates_; }
    [[nodiscard]] std::size_t calls() const noexcept { return base_.calls(); }

  private:
    /// sigma(s); growth_ is G(s) then.
    Real scale(const M& model, const Real& t, const State& s) noexcept
    {
        const auto both = model.time_scale(Scalar(t), s);
        const Real sigma = detail::plain_number(Scalar(both[0])), rate = detail::plain_number(Scalar(both[1]));
        growth_ = -rate / sigma;
        return sigma;
    }

    Base base_;
    State from_, rates_;
    Real epsilon_;           ///< with the sign of the direction
    Real density_ = Real(0); ///< rho of the step that is being made
    Real next_ = Real(0), growth_ = Real(0), length_ = Real(0);
};

/// A symmetric splitting `Method`, its step `step` times the model's time scale; `compensated` as there.
template <class Method>
struct Reversible {
    static_assert(Method::is_symmetric, "a step back has to undo a step");

    double step = 0;
    bool compensated = true;

    [[nodiscard]] constexpr Method base() const noexcept { return {.step = step, .compensated = compensated}; }
    /// Of no error: valid where the step is.
    [[nodiscard]] constexpr StepControl control() const noexcept
    {
        constexpr double large = std::numeric_limits<double>::max();
        return {.tolerance = step > 0 && step <= large ? 1.0 : -1.0};
    }

    template <class M>
    using Stepper = ReversibleStepper<Method, M>;
};

} // namespace lagen
