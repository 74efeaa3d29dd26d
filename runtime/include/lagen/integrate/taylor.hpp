// SPDX-License-Identifier: MIT
/// Taylor's method: the Taylor polynomial of the motion at the beginning of a step, by the recurrences of the generated
/// kernel `taylor`; order and step from the tolerance [Jorba-Zou 2005]. The polynomial is the dense output.
///   auto run = lagen::integrate(top, s, {0.0, 10.0}, lagen::Taylor{.tolerance = 1e-15});
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/isolate_roots.hpp"
#include "lagen/integrate/lanes.hpp"
#include "lagen/integrate/states.hpp"
#include "lagen/integrate/taylor_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lagen {

/// See integrate/stepper.hpp for what is asked of a stepper.
template <class M>
class TaylorStepper {
    static_assert(HasTaylor<M>,
                  "Taylor's method needs the recurrences of the model: lagen generate MODEL --with taylor");
    static_assert(!is_pack<typename M::Scalar> || detail::NamesTime<M>,
                  "adaptive methods choose one step for one trajectory: use a fixed-step method with packs, or "
                  "lagen::ensemble");

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using Number = real_t<Real>;
    using State = typename M::State;
    static constexpr bool adaptive = true;
    static constexpr bool abreast = true;
    static constexpr int highest_order = detail::highest_taylor_order<Number>;
    static constexpr int dense_order = highest_order;
    static constexpr int error_order = highest_order;
    static constexpr double beta_share = 0;
    static constexpr bool foresees = true; ///< its lengths come from the state alone, not from the last step

    template <class Method>
    explicit TaylorStepper(const Method& method) noexcept
        : control_(method.control()), scale_(control_), order_(order_of(method))
    {
    }

    status_t<Scalar> begin(const M& model, Real t, const State& s) noexcept
    {
        lost_.fill(Real(0));
        kept_ = lost_;
        return expand(model, t, s, here());
    }

    [[nodiscard]] Real first_step(const M&, Real, Real length, const State&) noexcept
    {
        const Real size = detail::size_of(length), wanted = here().length < unbounded() ? here().length : Real(1);
        const Real first = wanted < size ? wanted : size;
        return length < Real(0) ? Real(-first) : first;
    }

    /// s1 = s + sum_{k>0} x_k h^k, the lost digits of the last sum among them [Kahan 1965]; then the series there. The
    /// error is that of the polynomial in the equation at the end, against 16 tolerances, which shows a step beyond its
    /// radius of convergence:
    ///   h |P'(h) - f(P(h))| / (p + 1).
    /// Equations with kinks are refused by the generator: a kink that is crossed twice in a step leaves no trace there.
    status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        const Series& x = here().motion;
        if constexpr (HasDomain<M>) begins_ = {t, s};
        Row move = x[order_], slope;
        for (std::size_t i = 0; i < lanes; ++i) slope[i] = Real(order_) * x[order_][i];
        for (int k = order_ - 1; k > 0; --k)
            for (std::size_t i = 0; i < lanes; ++i) {
                move[i] = x[k][i] + h * move[i];
                slope[i] = Real(k) * x[k][i] + h * slope[i];
            }
        for (std::size_t i = 0; i < lanes; ++i) {
            const auto lane = static_cast<Eigen::Index>(i);
            const Real change = h * move[i] + kept_[i];
            const Real from = s[lane];
            s1[lane] = from + change;
            lost_[i] = change - (s1[lane] - from);
        }
        auto status = expand(model, t + h, s1, next());
        if (fails(status)) return status;
        status = Lanes::first(status, detail::check_finite(s1));
        if (fails(status)) return status;
        error_ = Real(0);
        const Real epsilon = Real(std::numeric_limits<Number>::epsilon());
        for (std::size_t i = 0; i < lanes; ++i) {
            const auto lane = static_cast<Eigen::Index>(i);
            const Real rate = next().motion[1][i];
            const Real bound = scale_.template of<1>(s, s1, lane) +
                               Real(4) * epsilon * (detail::size_of(s1[lane]) + detail::size_of(h * rate));
            const Real defect = detail::size_of(h * (slope[i] - rate)) / (Real(16) * Real(order_ + 1) * bound);
            error_ = select(error_ == error_ && !(defect <= error_), defect, error_);
        }
        return status;
    }

    [[nodiscard]] Real error() const noexcept { return error_; }

    /// A step is long: the domain is looked at inside it too, at equal parts.
    status_t<Scalar> finish([[maybe_unused]] const M& model, [[maybe_unused]] Real t1,
                            [[maybe_unused]] const State& s1) noexcept
    {
        auto status = Lanes::good();
        if constexpr (HasDomain<M>) {
            constexpr int parts = 16;
            const auto& [t, s] = begins_;
            State inside = s1;
            for (int k = 1; k < parts; ++k) {
                const Real theta = Real(k) / Real(parts);
                status = Lanes::first(status, interpolate(model, t, s, t1 - t, s1, theta, inside));
                if (fails(status)) return status;
                status = Lanes::first(status, detail::domain_status(model, t + theta * (t1 - t), inside));
                if (fails(status)) return status;
            }
        }
        return status;
    }

    void accept() noexcept
    {
        now_ = 1 - now_;
        kept_ = lost_;
    }

    /// As long as the series at its beginning allows; without a bound, ten times as long as the last one.
    [[nodiscard]] Real after_accepted(Real h, Real) noexcept
    {
        return next().length < unbounded() ? next().length : Real(10) * h;
    }
    [[nodiscard]] Real after_rejected(Real h, Real error) noexcept
    {
        const Real factor = detail::rough_power<Real>(-detail::rough_logarithm(error) / order_) * Real(0.9);
        return h * std::clamp<Real>(factor, Real(0.1), Real(0.9));
    }
    [[nodiscard]] Real after_failure(Real h) noexcept { return h / Real(2); }

    [[nodiscard]] State derivative() const noexcept
    {
        State rate;
        for (std::size_t i = 0; i < lanes; ++i) rate[static_cast<Eigen::Index>(i)] = here().motion[1][i];
        return rate;
    }

    /// The polynomial.
    status_t<Scalar> interpolate(const M&, Real, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        const Series& x = here().motion;
        const Real step = theta * h;
        Row move = x[order_];
        for (int k = order_ - 1; k > 0; --k)
            for (std::size_t i = 0; i < lanes; ++i) move[i] = x[k][i] + step * move[i];
        for (std::size_t i = 0; i < lanes; ++i) {
            const auto lane = static_cast<Eigen::Index>(i);
            out[lane] = s[lane] + (step * move[i] + kept_[i]);
        }
        return detail::check_finite(out);
    }

    /// The ends of parts of the step, (0, last] in units of h, in each of which no event changes its sign twice:
    /// the roots of the events' own Taylor polynomials are isolated. False where there are none.
    template <class Found>
    bool split(Real h, Real last, const Found& found) const
    {
        if constexpr (HasEventSeries<M>) {
            if (!here().events.known) return false;
            const auto& e = here().events.of;
            constexpr auto events = M::events_names.size();
            const Real length = last * h;
            for (std::size_t r = 0; r < events; ++r) {
                std::array<Real, highest_order + 1> coefficients;
                Real power = Real(1), total = Real(0);
                for (int k = 0; k <= order_; ++k, power *= length)
                    total += coefficients[static_cast<std::size_t>(k)] = e[k][r] * power;
                if (total - total != Real(0)) return false; // no series here
                using Isolation = detail::RootIsolation<Real, highest_order + 1>;
                Isolation::isolate(coefficients, static_cast<std::size_t>(order_) + 1,
                                   std::numeric_limits<Real>::epsilon() * Real(64),
                                   [&](const Real& end) { found(end * last); });
            }
            return true;
        }
        return false;
    }

    /// A series counts as one call.
    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }
    [[nodiscard]] int order() const noexcept { return order_; }

    // ---- of packs whose lanes are trajectories: integrate/abreast.hpp ----

    /// Can a trajectory of `own` go on a lane beside the others?
    template <class One>
    [[nodiscard]] bool suits(const TaylorStepper<One>& own) const noexcept requires(is_pack<Scalar>)
    {
        return own.order_ == order_;
    }

    /// Lane `lane` begins as `own`, the stepper of its trajectory, has begun.
    template <class One>
    void adopt(int lane, const TaylorStepper<One>& own) noexcept requires(is_pack<Scalar>)
    {
        scale_.set_lane(lane, own.scale_);
        set_lane(here().motion, lane, own.here().motion);
        here().length.set(lane, own.here().length);
        if constexpr (HasEventSeries<M>) {
            set_lane(here().events.of, lane, own.here().events.of);
            here().events.known.lanes[lane] = own.here().events.known ? -1 : 0;
        }
        for (std::size_t i = 0; i < lanes; ++i) kept_[i].set(lane, own.kept_[i]);
    }

    /// What values inside the last step of lane `lane` are made of, and how long the step behind it may be.
    template <class One>
    void hand_over(int lane, TaylorStepper<One>& own) const noexcept requires(is_pack<Scalar>)
    {
        get_lane(here().motion, lane, own.here().motion);
        if constexpr (HasEventSeries<M>) {
            get_lane(here().events.of, lane, own.here().events.of);
            own.here().events.known = here().events.known[lane];
        }
        for (std::size_t i = 0; i < lanes; ++i) own.kept_[i] = kept_[i][lane];
    }
    template <class One>
    void hand_over_length(int lane, TaylorStepper<One>& own) const noexcept requires(is_pack<Scalar>)
    {
        own.next().length = expansions_[1 - now_].length[lane];
    }

    /// The step counts in these lanes.
    void accept(const typename StatusOf<Scalar>::mask& where) noexcept requires(is_pack<Scalar>)
    {
        for (std::size_t i = 0; i < lanes; ++i) kept_[i] = select(where, lost_[i], kept_[i]);
        now_ = 1 - now_;
        if (all(where)) return;
        choose(where, here().motion, next().motion);
        here().length = select(where, here().length, next().length);
        if constexpr (HasEventSeries<M>) {
            choose(where, here().events.of, next().events.of);
            here().events.known = (where && here().events.known) || (!where && next().events.known);
        }
    }

  private:
    template <class>
    friend class TaylorStepper;
    using Lanes = StatusOf<Scalar>;
    static bool fails(const status_t<Scalar>& status) noexcept { return !is_pack<Scalar> && !Lanes::all_good(status); }

    template <class Of, class One>
    void set_lane(Of& series, int lane, const One& own) const noexcept
    {
        for (int k = 0; k <= order_; ++k)
            for (std::size_t i = 0; i < own[k].size(); ++i) series[k][i].set(lane, own[k][i]);
    }
    template <class Of, class One>
    void get_lane(const Of& series, int lane, One& own) const noexcept
    {
        for (int k = 0; k <= order_; ++k)
            for (std::size_t i = 0; i < own[k].size(); ++i) own[k][i] = series[k][i][lane];
    }
    /// Lanes that are not `where` become those of `other`.
    template <class Where, class Of>
    void choose(const Where& where, Of& series, const Of& other) const noexcept
    {
        for (int k = 0; k <= order_; ++k)
            for (std::size_t i = 0; i < series[k].size(); ++i) series[k][i] = select(where, series[k][i], other[k][i]);
    }

    static constexpr auto lanes = static_cast<std::size_t>(M::dimension);
    using Series = TaylorSeries<Real, M::dimension, highest_order>;
    using Row = typename Series::Row;
    static Number unbounded() noexcept { return std::numeric_limits<Number>::max(); }

    template <class Method>
    static int order_of(const Method& method) noexcept
    {
        if (method.order > 0) return std::clamp(method.order, 2, highest_order);
        const StepControl control = method.control();
        const double tolerance = control.relative_tolerance();
        const double logarithm = -std::log(tolerance > 0 ? tolerance : control.absolute_tolerance());
        if (!std::isfinite(logarithm)) return highest_order; // integrate refuses such tolerances
        int sums = 0;
        if constexpr (requires { M::taylor_sums; }) sums = M::taylor_sums;
        return std::clamp(detail::taylor_order<Number>(logarithm, sums), 3, highest_order);
    }

    /// The motion's series and those of its events, and how far they hold.
    struct Expansion {
        Series motion;
        [[no_unique_address]] detail::EventSeries<M, highest_order> events;
        Real length = Real(0);
    };
    [[nodiscard]] Expansion& here() noexcept { return expansions_[now_]; }
    [[nodiscard]] const Expansion& here() const noexcept { return expansions_[now_]; }
    [[nodiscard]] Expansion& next() noexcept { return expansions_[1 - now_]; }

    status_t<Scalar> expand(const M& model, Real t, const State& s, Expansion& at) noexcept
    {
        ++calls_;
        auto status = model.taylor(t, s, order_, at.motion);
        if (fails(status)) return status;
        Real total = Real(0);
        for (const Real& coefficient : at.motion[order_]) total += coefficient;
        Lanes::fail(status, total - total != Real(0), Status::non_finite);
        if (fails(status)) return status;
        const detail::TaylorLength<Scalar> lengths{scale_, order_};
        at.length = lengths.of_motion(s, at.motion);
        if constexpr (HasEventSeries<M>) {
            const auto known = model.event_series(t, s, order_, at.motion, at.events.of);
            at.events.known = detail::is_good<Scalar>(known);
            const Scalar with_events = lengths.of_events(at.length, at.events.of, M::events_names.size());
            at.length = select(at.events.known, with_events, at.length);
        }
        return status;
    }

    std::array<Expansion, 2> expansions_; ///< at the beginning of the step, and at its end
    Row kept_, lost_;
    std::pair<Real, State> begins_; ///< the last step that was tried, where the model has a domain
    StepControl control_;
    detail::ErrorScale<Real> scale_;
    Real error_ = Real(0);
    int order_;
    std::size_t now_ = 0;
    std::size_t calls_ = 0;
};

/// Order and step from the tolerance; `order` fixes the order, and the tolerance the step alone. The order goes up to
/// what the digits of the scalar are worth: 30 for double, 41 for __float128, 60 for 50 digits.
struct Taylor {
    double tolerance = 1e-15;
    double relative = -1;
    double absolute = -1;
    double first_step = 0;
    double max_step = 0;
    int order = 0;

    [[nodiscard]] constexpr StepControl control() const noexcept
    {
        return {.tolerance = tolerance,
                .relative = relative,
                .absolute = absolute,
                .first_step = first_step,
                .max_step = max_step};
    }

    template <class M>
    using Stepper = TaylorStepper<M>;
};

} // namespace lagen
