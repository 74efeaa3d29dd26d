// SPDX-License-Identifier: MIT
/// Runge-Kutta methods in the exponential chart around the beginning of each step [Munthe-Kaas, Applied Numerical
/// Mathematics 29 (1999) 115]:
///   Rkmk4{.step = h}                  the classical method of order 4
///   RkmkDop853{.tolerance = e}        DOP853, step control and dense output included
///   GaussLie4{.step = h}              Gauss' collocation of two stages
/// They have the order of their tableau, and lanes that the group moves stay on their orbit: matrices on their group,
/// vectors on their sphere, momenta on their coadjoint orbit, with every Casimir, all to rounding, the errors of which
/// are carried along [Kahan 1965]. A step that turns by more than 2.5 or so is refused with branch_lost.
#pragma once

#include "lagen/dop853.hpp"
#include "lagen/fixed_step.hpp"
#include "lagen/gauss.hpp"
#include "lagen/group/exponential_chart.hpp"
#include "lagen/run.hpp"

namespace lagen {

/// The stepper: see integrate/stepper.hpp for what is asked of it. `Base` is one for the equations in the chart.
template <class Base, class M>
class ChartStepper : public Base {
  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using State = typename M::State;
    static constexpr bool abreast = false;

    template <class Method>
    explicit ChartStepper(const Method& method) : Base(method)
    {
    }

    Status begin(const M& model, const Real& t, const State& s) noexcept
    {
        lost_ = next_lost_ = State::Zero(s.size());
        chart_.centre(model, s);
        return Base::begin(chart_, t, chart_.origin());
    }

    [[nodiscard]] Real first_step(const M& model, const Real& t, const Real& length, const State& s) noexcept
        requires(Base::adaptive)
    {
        ++this->calls_;
        State x, ahead;
        return detail::first_step(model, this->control_, Base::order, t, length, s, derivative(), x, ahead);
    }

    Status attempt(const M& model, const Real& t, const State& s, const Real& h, State& s1) noexcept
    {
        chart_.centre(model, s);
        const Status status = Base::attempt(chart_, t, chart_.origin(), h, end_);
        if (status != Status::ok) return status;
        chart_.find_state(t, end_, s1, lost_, next_lost_);
        return detail::check_finite(s1);
    }

    Status finish(const M&, const Real& t1, const State&) noexcept requires(Base::adaptive)
    {
        const Status status = Base::finish(chart_, t1, end_);
        velocities_ = chart_.velocities();
        return status;
    }

    /// The next chart is that around the end, where the rates are those of no chart.
    void accept() noexcept
    {
        Base::accept();
        lost_ = next_lost_;
        if constexpr (Base::adaptive) this->k_.front() = velocities_;
    }

    [[nodiscard]] State derivative() const noexcept requires(Base::adaptive)
    {
        return chart_.in_lanes(Real(0), Base::derivative());
    }

    /// On the orbit too.
    Status interpolate(const M& model, const Real& t, const State& s, const Real& h, const State&, const Real& theta,
                       State& out) noexcept
    {
        chart_.centre(model, s);
        Chart inside;
        const Status status = Base::interpolate(chart_, t, chart_.origin(), h, end_, theta, inside);
        if (status != Status::ok) return status;
        State ignored;
        chart_.find_state(t, inside, out, lost_, ignored);
        return detail::check_finite(out);
    }

    void polynomial() const = delete; ///< that of the base is one in the chart

  private:
    using Chart = typename detail::ExponentialChart<M>::State;

    detail::ExponentialChart<M> chart_;
    Chart end_, velocities_; ///< u at the end of the step, and the rates there in the chart around it
    State lost_, next_lost_; ///< of the sums, before and behind a step
};

/// A method of fixed `step` in the chart.
template <class Method>
struct ChartMethod {
    double step = 0;
    static constexpr bool compensated = Method{}.compensated;

    template <class M>
    using Stepper = ChartStepper<typename Method::template Stepper<detail::ExponentialChart<M>>, M>;
};

struct RkmkDop853Family {
    static constexpr StepControl defaults = Dop853Family::defaults;
    template <class M>
    using Stepper = ChartStepper<Dop853Stepper<detail::ExponentialChart<M>>, M>;
};

using Rkmk4 = ChartMethod<Rk4>;
using GaussLie4 = ChartMethod<Gauss4>;
using RkmkDop853 = AdaptiveMethod<RkmkDop853Family>;

} // namespace lagen
