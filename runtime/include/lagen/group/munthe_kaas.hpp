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
#include "lagen/group/algebra_action.hpp"
#include "lagen/integrate/control.hpp"
#include "lagen/run.hpp"

#include <cmath>
#include <limits>

namespace lagen::detail {

// The equations of a motion that a group moves, in the chart u = (theta, z) around a state s of it:
// s(u) = exp(A(theta)) s in the lanes that the group moves,  z in the others
// theta' = dexp^-1_theta(xi(t, s(u))),  z' = f(t, s(u))
// Whatever method integrates u, s(u) stays on the orbit of s [Munthe-Kaas, BIT 38 (1998) 92].

template <MovesByGroup M>
class ExponentialChart {
  public:
    using Scalar = typename M::Scalar;
    static_assert(!is_pack<Scalar>, "methods on groups take one trajectory at a time");
    static constexpr int algebra_dimension = M::algebra_dimension;
    static constexpr auto free_count = static_cast<int>(free_lanes<M>.size());
    static constexpr int dimension = algebra_dimension + free_count;
    using State = Eigen::Matrix<Scalar, dimension, 1>;

    /// Puts the chart around s.
    void centre(const M& model, const typename M::State& s) noexcept
    {
        model_ = &model;
        centre_ = s;
    }

    /// u of the centre.
    [[nodiscard]] State origin() const noexcept
    {
        State u = State::Zero();
        for (int k = 0; k < free_count; ++k) u[algebra_dimension + k] = centre_[lane(k)];
        return u;
    }

    /// s(u), whose sums begin with -lost, and the rounding error of these.
    void find_state(const Scalar& t, const State& u, typename M::State& s, const typename M::State& lost,
                    typename M::State& next_lost) const noexcept
    {
        typename M::State increment;
        add_motion<false>(*model_, t, centre_, AlgebraElement<M>(u.template head<algebra_dimension>()), increment);
        increment -= lost;
        s = centre_ + increment;
        next_lost = (s - centre_) - increment;
        for (int k = 0; k < free_count; ++k) {
            s[lane(k)] = u[algebra_dimension + k];
            next_lost[lane(k)] = Scalar(0);
        }
    }

    /// branch_lost where the chart does not reach so far.
    Status rhs(const Scalar& t, const State& u, State& du) const noexcept
    {
        const AlgebraElement<M> theta = u.template head<algebra_dimension>();
        const typename M::State nothing = M::State::Zero();
        typename M::State s, ignored;
        find_state(t, u, s, nothing, ignored);
        const Status status = velocities(t, s, du);
        if (status != Status::ok) return status;
        velocities_ = du;
        AlgebraElement<M> rate;
        if (!inverse_(*model_, theta, du.template head<algebra_dimension>(), rate)) return Status::branch_lost;
        du.template head<algebra_dimension>() = rate;
        return Status::ok;
    }

    /// (xi, f) at the last state that `rhs` was asked at: the rates in the chart around that state.
    [[nodiscard]] const State& velocities() const noexcept { return velocities_; }

    /// What a small u - origin is in the lanes of the state: A(theta) s, z.
    [[nodiscard]] typename M::State in_lanes(const Scalar& t, const State& du) const noexcept
    {
        typename M::State ds =
            model_->algebra_action(t, centre_, AlgebraElement<M>(du.template head<algebra_dimension>()));
        for (int k = 0; k < free_count; ++k) ds[lane(k)] = du[algebra_dimension + k];
        return ds;
    }

    /// Errors are measured in the lanes of the state, at the centre.
    [[nodiscard]] Scalar squared_error(const ErrorScale<Scalar>& scale, const Scalar& t, const State& e) const noexcept
    {
        return detail::squared_error(scale, centre_, centre_, in_lanes(t, e));
    }

    // ---- for Newton's method, whose equations are exact, and which needs no more than a Jacobian close to theirs ----

    static constexpr auto jacobian_entries = static_cast<std::size_t>(dimension) * static_cast<std::size_t>(dimension);
    static constexpr std::array<int, jacobian_entries> jacobian_rows = [] {
        std::array<int, jacobian_entries> rows{};
        for (std::size_t k = 0; k < jacobian_entries; ++k) rows[k] = static_cast<int>(k) / dimension;
        return rows;
    }();
    static constexpr std::array<int, jacobian_entries> jacobian_columns = [] {
        std::array<int, jacobian_entries> columns{};
        for (std::size_t k = 0; k < jacobian_entries; ++k) columns[k] = static_cast<int>(k) % dimension;
        return columns;
    }();

    /// Differences of the rates, half the digits long.
    void jacobian_values(const Scalar& t, const State& u, std::array<Scalar, jacobian_entries>& values) const noexcept
    {
        using std::sqrt;
        const Scalar half = sqrt(Scalar(std::numeric_limits<Scalar>::epsilon()));
        State here, there;
        Status status = rhs(t, u, here);
        for (int column = 0; column < dimension; ++column) {
            State v = u;
            v[column] += half * size_of_unit(t, column);
            status = status == Status::ok ? rhs(t, v, there) : status;
            const Scalar length = v[column] - u[column];
            for (int row = 0; row < dimension; ++row)
                values[static_cast<std::size_t>(row * dimension + column)] =
                    status == Status::ok ? Scalar((there[row] - here[row]) / length)
                                         : std::numeric_limits<Scalar>::quiet_NaN();
        }
    }

  private:
    [[nodiscard]] static Eigen::Index lane(int k) noexcept { return free_lanes<M>[static_cast<std::size_t>(k)]; }

    Status velocities(const Scalar& t, const typename M::State& s, State& du) const noexcept
    {
        AlgebraElement<M> xi;
        Status status = model_->algebra_element(t, s, xi);
        du.template head<algebra_dimension>() = xi;
        if constexpr (free_count > 0) {
            typename M::State ds;
            if (status == Status::ok) status = model_->rhs(t, s, ds);
            for (int k = 0; k < free_count; ++k) du[algebra_dimension + k] = ds[lane(k)];
        }
        return status;
    }

    /// How far u may go in this direction until the lanes that it moves have moved by their size; 1 where they are 0.
    [[nodiscard]] Scalar size_of_unit(const Scalar& t, int column) const noexcept
    {
        const typename M::State moved = in_lanes(t, State::Unit(column));
        Scalar size(0), path(0);
        for (Eigen::Index k = 0; k < moved.size(); ++k) {
            path += size_of(moved[k]);
            if (moved[k] != Scalar(0)) size += size_of(centre_[k]);
        }
        return size > Scalar(0) && path > Scalar(0) ? Scalar(size / path) : Scalar(1);
    }

    const M* model_ = nullptr;
    typename M::State centre_;
    InverseDifferential<M> inverse_;
    mutable State velocities_;
};

} // namespace lagen::detail

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
