// SPDX-License-Identifier: MIT
/// The march from the start of an interval to its end: one loop for every method. A stepper offers
///   begin(model, t, s)                        once, at the start
///   attempt(model, t, s, h, s1)               a step of length h into s1; `error()` where adaptive
///   finish(model, t1, s1), accept()           the derivative at the end where it is needed; then the step counts
///   interpolate(model, t, s, h, s1, theta, out)   a value inside the last attempted step
///   calls()                                   of the right-hand side so far
/// Adaptive ones may choose their steps themselves: after_accepted(h, error), after_rejected(h, error),
/// after_failure(h). Implicit ones count newton_iterations() and decompositions(). Nothing in a step allocates; rows,
/// and lists of events found, grow outside of it.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/creeping.hpp"
#include "lagen/integrate/watch_events.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace lagen::detail {

template <class M, class Method, class Observer>
class March {
  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    using Stepper = typename Method::template Stepper<M>;
    static Real epsilon() noexcept { return std::numeric_limits<Real>::epsilon(); }
    /// Adaptive steps are long and their interpolants cheap: events are looked for in four pieces of each.
    static constexpr int pieces = Stepper::adaptive ? 4 : 1;
    static constexpr bool chooses_lengths = requires(Stepper stepper, Real h) { stepper.after_failure(h); };

    March(const M& model, const State& s, Interval<Real> span, const Method& method, const Options<M>& options,
          Observer& observer)
        : model_(model), span_(span), method_(method), options_(options), observer_(observer), stepper_(method),
          watch_(model, options.events), s_(s), s1_(s), inner_(s), t_(span.start),
          reach_(std::max<Real>(size(span.start), size(span.end)))
    {
    }

    Run<M> run()
    {
        Status status = begin();
        while (status == Status::ok && t_ != span_.end) {
            status = interruption();
            if (status == Status::ok) status = step();
        }
        run_.t = t_;
        run_.state = s_;
        run_.rhs_calls = stepper_.calls();
        if constexpr (requires { stepper_.newton_iterations(); }) {
            run_.newton_iterations = stepper_.newton_iterations();
            run_.decompositions = stepper_.decompositions();
        }
        if (is_success(status)) run_.failed_at = t_;
        run_.outcome = status;
        if constexpr (is_pack<Scalar>) {
            for (Status lane : run_.lanes.lanes)
                if (run_.outcome == Status::ok) run_.outcome = lane;
        } else {
            run_.lanes = status;
        }
        return std::move(run_);
    }

  private:
    static Real size(Real x) noexcept { return x < Real(0) ? -x : x; }

    // ---- start ----

    Status begin()
    {
        run_.failed_at = t_;
        const Real length = span_.end - span_.start;
        if (length - length != Real(0) || !watch_.is_valid()) return Status::invalid_input;
        if (is_pack<Scalar> && !watch_.empty()) return Status::invalid_input;
        forward_ = !(length < Real(0));
        if (!rows_are_in_order()) return Status::invalid_input;
        if (!step_is_valid()) return Status::invalid_input;
        auto status = check_finite(s_);
        if constexpr (requires { model_.parameter_status(); })
            status = StatusOf<Scalar>::first(model_.parameter_status(), status);
        status = StatusOf<Scalar>::first(status, domain_status(t_, s_));
        if (is_pack<Scalar> || StatusOf<Scalar>::all_good(status))
            status = StatusOf<Scalar>::first(status, stepper_.begin(model_, t_, s_));
        const Status verdict = settle(status);
        if (verdict != Status::ok) return verdict;
        if (!watch_.empty()) watch_.begin(t_, s_);
        if constexpr (Stepper::adaptive) choose_first_step(length);
        skip_rows_before_start();
        rows_until(t_, [&](Real) { return &s_; });
        if constexpr (requires { observer_(t_, s_); }) observer_(t_, s_);
        return Status::ok;
    }

    bool step_is_valid() noexcept
    {
        if constexpr (Stepper::adaptive) {
            return method_.control().is_valid();
        } else {
            h_ = static_cast<Real>(method_.step);
            return h_ > Real(0) && h_ - h_ == Real(0);
        }
    }

    void choose_first_step(Real length) noexcept requires(Stepper::adaptive)
    {
        const Real first = static_cast<Real>(method_.control().first_step);
        h_ = first > Real(0) ? first : size(length == Real(0) ? Real(0) : stepper_.first_step(model_, t_, length, s_));
        if constexpr (!chooses_lengths)
            controller_ = Controller<Real>(method_.control(), Stepper::error_order, Real(Stepper::beta_share));
    }

    /// Whose lengths the next steps have.
    auto& lengths() noexcept
    {
        if constexpr (chooses_lengths)
            return stepper_;
        else
            return controller_;
    }

    /// Failures of lanes are kept, and those lanes stay as they are; a failure of every lane ends the run.
    Status settle(const status_t<Scalar>& status) noexcept
    {
        if constexpr (is_pack<Scalar>) {
            run_.lanes = StatusOf<Scalar>::first(run_.lanes, status);
            const auto& lanes = run_.lanes.lanes;
            return std::find(lanes.begin(), lanes.end(), Status::ok) == lanes.end() ? lanes.front() : Status::ok;
        } else {
            return status;
        }
    }

    /// Lanes that failed keep the state `from`.
    void freeze(const State& from, State& to) const noexcept
    {
        if constexpr (is_pack<Scalar>) {
            if (StatusOf<Scalar>::all_good(run_.lanes)) return;
            for (int lane = 0; lane < RealOf<Scalar>::lanes; ++lane)
                if (run_.lanes[lane] != Status::ok)
                    for (Eigen::Index i = 0; i < to.size(); ++i) to[i].set(lane, from[i][lane]);
        }
    }

    Status interruption()
    {
        run_.failed_at = t_;
        const std::size_t tried = run_.steps + run_.rejected;
        if (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed)) return Status::interrupted;
        if (options_.signal != nullptr && *options_.signal != 0) return Status::interrupted;
        if (tried >= options_.max_steps) return Status::too_many_steps;
        if (options_.progress && tried % 256 == 255)
            options_.progress(static_cast<double>((t_ - span_.start) / (span_.end - span_.start)));
        return Status::ok;
    }

    // ---- one step ----

    /// The signed length of the next step, and whether it ends the interval. An end within rounding of the step's is
    /// the step's.
    std::pair<Real, bool> next_length() const noexcept
    {
        const Real rest = size(span_.end - t_);
        Real length = h_;
        bool last = false;
        if constexpr (Stepper::adaptive) {
            // A rest of up to 1.01 steps is one step, so that no tiny one is left; but never beyond the cap.
            const Real cap = static_cast<Real>(method_.control().max_step);
            Real reaches = Real(1.01) * length;
            if (cap > Real(0) && length > cap) length = cap;
            if (cap > Real(0) && reaches > cap) reaches = cap;
            last = reaches >= rest;
        } else {
            last = rest <= length + Real(8) * epsilon() * reach_;
        }
        if (last) length = rest;
        return {forward_ ? length : -length, last};
    }

    Status step()
    {
        const auto [h, last] = next_length();
        if constexpr (Stepper::adaptive)
            if (!last && is_lost_in_time(h_)) return Status::step_too_small;
        // Compensated sum of the times [Kahan 1965].
        const Real increment = h - lost_;
        const Real t1 = last ? span_.end : t_ + increment;
        const auto status = stepper_.attempt(model_, t_, s_, h, s1_);
        if constexpr (Stepper::adaptive) {
            const Status verdict = judge(status, h, t1);
            if (verdict != Status::ok || retry_) return verdict;
        } else {
            run_.failed_at = t1;
            const auto watched = is_pack<Scalar> ? StatusOf<Scalar>::first(status, domain_status(t1, s1_)) : status;
            const Status verdict = settle(watched);
            if (verdict != Status::ok) return verdict;
            freeze(s_, s1_);
        }
        const Status ending = commit(h, t1);
        lost_ = last ? Real(0) : (t1 - t_before_) - increment;
        if constexpr (requires { observer_(t_, s_); }) observer_(t_, s_);
        return ending;
    }

    /// Accepts or rejects a step of an adaptive method and proposes the next length.
    Status judge(Status status, Real h, Real t1) noexcept requires(Stepper::adaptive)
    {
        retry_ = true;
        const Real error = status == Status::ok ? stepper_.error() : Real(0);
        if (status == Status::ok && error - error != Real(0)) status = Status::non_finite;
        if (status == Status::ok && error > Real(1)) {
            imprecise_ = true;
            h_ = lengths().after_rejected(size(h), error);
            return rejection_verdict(Status::step_too_small, t1);
        }
        if (status == Status::ok) status = stepper_.finish(model_, t1, s1_);
        if (status != Status::ok) {
            if (failed_length_ == Real(0)) failed_length_ = h;
            h_ = lengths().after_failure(size(h));
            return rejection_verdict(status, t1);
        }
        retry_ = false;
        imprecise_ = false;
        failed_length_ = Real(0);
        h_ = lengths().after_accepted(size(h), error);
        return Status::ok;
    }

    /// Counts a rejected step; `reason` where it ends the run.
    Status rejection_verdict(Status reason, Real t1) noexcept
    {
        ++run_.rejected;
        if (!creeping_.creeps(t_, span_.end - span_.start, run_.steps, run_.rejected)) return size_verdict(reason, t1);
        run_.failed_at = t1;
        return reason;
    }

    /// Within the rounding of time?
    bool is_lost_in_time(Real length) const noexcept
    {
        const Real scale = std::max<Real>(size(t_), epsilon() * size(span_.end - span_.start));
        return !(Real(0.1) * length > epsilon() * scale);
    }

    /// `reason` where the next step would be lost in the rounding of time; left_domain in a run into the boundary.
    Status size_verdict(Status reason, Real t1) noexcept
    {
        if (!is_lost_in_time(h_)) return Status::ok;
        run_.failed_at = t1;
        if constexpr (HasDomain<M> && Stepper::adaptive) {
            inner_ = s_ + failed_length_ * stepper_.derivative();
            if (reason != Status::step_too_small && domain_status(t1, inner_) != Status::ok) return Status::left_domain;
        }
        // Shorter steps were finite and failed by their error: the tolerance cannot be met.
        return reason == Status::non_finite && imprecise_ ? Status::step_too_small : reason;
    }

    // ---- what an accepted step brings ----

    status_t<Scalar> domain_status(Real t, const State& s) const noexcept
    {
        auto status = StatusOf<Scalar>::good();
        if constexpr (HasDomain<M>) {
            const auto values = model_.domain(Scalar(t), s);
            for (Eigen::Index i = 0; i < values.size(); ++i)
                StatusOf<Scalar>::fail(status, !(values[i] > Scalar(0)), Status::left_domain);
        }
        return status;
    }

    /// Boundary, events, rows; then the state moves to the end of the step, or to where the run ends.
    Status commit(Real h, Real t1)
    {
        Real theta = Real(1);
        Status ending = Status::ok;
        const auto at = [&](Real x) { return inside(x, h, t1); };
        if constexpr (HasDomain<M> && !is_pack<Scalar>) {
            if (domain_status(t1, s1_) != Status::ok) {
                const auto edge = locate_boundary(Real(0), Real(1), theta_width(h), [&](Real x) {
                    const auto [t, s] = at(x);
                    return domain_status(t, *s) == Status::ok;
                });
                theta = edge.before;
                run_.failed_at = t_ + edge.after * h;
                ending = Status::left_domain;
            }
        }
        if (!watch_.empty())
            for (const auto& crossed : watch_.look(theta, pieces, theta_width(h), at)) {
                const auto [t, s] = at(crossed.theta);
                run_.events.push_back({crossed.request, t, *s});
                if (!crossed.stop) continue;
                theta = crossed.theta;
                ending = Status::stopped_by_event;
            }
        move(theta, h, t1);
        return ending;
    }

    Real theta_width(Real h) const noexcept
    {
        return std::max<Real>(Real(2) * epsilon(), epsilon() * std::max<Real>(size(t_), size(t_ + h)) / size(h));
    }

    std::pair<Real, const State*> inside(Real theta, Real h, Real t1) noexcept
    {
        if (theta == Real(1)) return {t1, &s1_};
        if (theta == Real(0)) return {t_, &s_};
        if (!StatusOf<Scalar>::all_good(stepper_.interpolate(model_, t_, s_, h, s1_, theta, inner_)) &&
            !is_pack<Scalar>)
            inner_ = s_ + theta * (s1_ - s_);
        freeze(s_, inner_);
        return {t_ + theta * h, &inner_};
    }

    void move(Real theta, Real h, Real t1)
    {
        const Real end = theta == Real(1) ? t1 : t_ + theta * h;
        rows_until(end, [&](Real time) {
            // A row within rounding of the step's end is the step's end.
            Real x = (time - t_) / h;
            if (x > theta || size(time - end) <= Real(4) * epsilon() * reach_) x = theta;
            return inside(x, h, t1).second;
        });
        const State* s = inside(theta, h, t1).second;
        t_before_ = t_;
        t_ = end;
        s_ = *s;
        stepper_.accept();
        ++run_.steps;
    }

    // ---- rows ----

    bool is_after(Real a, Real b) const noexcept { return forward_ ? a > b : a < b; }

    /// In the direction of the run, and none of them NaN.
    [[nodiscard]] bool rows_are_in_order() const noexcept
    {
        for (std::size_t k = 0; k < options_.at.size(); ++k) {
            if (options_.at[k] != options_.at[k]) return false;
            if (k > 0 && is_after(options_.at[k - 1], options_.at[k])) return false;
        }
        return true;
    }

    void skip_rows_before_start() noexcept
    {
        while (row_ < options_.at.size() && is_after(span_.start, options_.at[row_])) ++row_;
    }

    /// Rows at the times up to `end`, rounding included.
    template <class At>
    void rows_until(Real end, const At& at)
    {
        const Real slack = Real(4) * epsilon() * reach_;
        while (row_ < options_.at.size()) {
            const Real time = options_.at[row_];
            if (is_after(time, end) && size(time - end) > slack) return;
            if (is_after(time, span_.end)) return;
            const State* state = at(time);
            if constexpr (requires { observer_.row(time, *state); }) {
                observer_.row(time, *state);
            } else {
                run_.times.push_back(time);
                run_.states.push_back(*state);
            }
            ++row_;
        }
    }

    const M& model_;
    Interval<Real> span_;
    const Method& method_;
    const Options<M>& options_;
    Observer& observer_;
    Stepper stepper_;
    EventWatch<M> watch_;
    Controller<Real> controller_{StepControl{}, 5, Real(0)};
    Run<M> run_;
    State s_, s1_, inner_;
    Real t_;
    Real reach_; ///< the largest |t| of the interval
    Real t_before_ = Real(0);
    Real lost_ = Real(0);
    Real h_ = Real(0);             ///< positive: the length that the method or the controller asks for
    Real failed_length_ = Real(0); ///< of the first of a series of steps that could not be evaluated
    CreepingWatch<Real> creeping_{span_.start};
    std::size_t row_ = 0;
    bool forward_ = true;
    bool retry_ = false;
    bool imprecise_ = false; ///< since the last accepted step, one was rejected by its error
};

} // namespace lagen::detail
