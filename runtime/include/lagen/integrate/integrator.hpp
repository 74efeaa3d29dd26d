// SPDX-License-Identifier: MIT
/// `lagen::Integrator integrator(model, s, t, method);`: one step after another, forwards and backwards.
///   integrator.step()              a step of the method, as long as it likes
///   integrator.advance_to(t)       steps to exactly t
///   integrator.at(t)               the state inside the last step
///   integrator.hold({.u = 2})      the inputs of the model from here on
/// A stepper does the work: integrate/stepper.hpp.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/follow.hpp"
#include "lagen/integrate/retract.hpp"
#include "lagen/integrate/states.hpp"
#include "lagen/integrate/stepper.hpp"
#include "lagen/integrate/way.hpp"
#include "lagen/lanes/lanes.hpp"
#include "lagen/requirements.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <new>
#include <utility>

namespace lagen::detail {

// When an adaptive run gets nowhere: a right-hand side that changes or fails without a pattern has its steps rejected
// at every length, between lengths that are still accepted.

/// Counts rejected steps and what they bring. Without it such a run would end after Options::max_steps, which may be
/// years.
template <class Real>
class CreepingWatch {
  public:
    static constexpr std::size_t rejections = 10'000;
    static constexpr double share = 1e-4; ///< at this pace an interval takes 10^8 rejections

    explicit CreepingWatch(const Real& start) noexcept : from_(start) {}

    /// After a rejected step at `t` of a run with so many accepted and rejected ones: true where its last `rejections`,
    /// at least one in five of the steps that were tried, covered no more than `share` of the interval's length.
    [[nodiscard]] bool creeps(const Real& t, const Real& length, std::size_t accepted, std::size_t rejected) noexcept
    {
        if (rejected - rejected_ < rejections) return false;
        const Real way = t < from_ ? Real(from_ - t) : Real(t - from_);
        const Real whole = length < Real(0) ? Real(-length) : length;
        const bool slow = accepted - accepted_ <= 4 * rejections && way <= static_cast<Real>(share) * whole;
        from_ = t;
        accepted_ = accepted;
        rejected_ = rejected;
        return slow;
    }

  private:
    Real from_;
    std::size_t accepted_ = 0, rejected_ = 0;
};

} // namespace lagen::detail

namespace lagen {

/// An initial-value problem and where it stands. It keeps the model and allocates nothing in a step. Every status is
/// that of `integrate`; a step that fails leaves time and state as they are. Of a pack, lanes that fail keep their
/// state while the others go on (`lanes()`), and the status is not ok where all have failed.
template <Motion M, class Method>
class Integrator {
  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    using Stepper = typename Method::template Stepper<M>;

    /// From the state s at time t. A start that is refused (invalid_input, left_domain, non_finite, or what the model
    /// answers) is the status(), and that of every step.
    Integrator(const M& model, const State& s, const Real& t, const Method& method)
        : model_(model), method_(method), stepper_(method), s_(s), from_(s), inner_(s), t_(t), t_from_(t),
          failed_at_(t), origin_(t), way_(t), creeping_(t)
    {
        status_ = begin();
    }

    /// In the direction of the last step (the first one: forwards), of the length that the method asks for.
    Status step()
    {
        way_.bounded = false;
        way_.near = Real(-1);
        prepare(way_.directed(std::numeric_limits<Real>::max()));
        return one_step();
    }

    /// One step that does not go beyond `end`; none where t() is there.
    Status step_towards(const Real& end)
    {
        if (!aim(end)) return Status::invalid_input;
        return status_ == Status::ok && t_ == way_.end ? Status::ok : one_step();
    }

    /// From t() on the inputs of the model are these. What the method and at() know of the last step is dropped.
    template <class Model = M>
    Status hold(const typename Model::Inputs& inputs)
    {
        open();
        model_.inputs = inputs;
        return status_ = begin();
    }

    static constexpr std::size_t most_steps = 100'000'000; ///< of one advance_to; beyond them it is too_many_steps
    /// Steps until t() == end, the last one shortened. A failure leaves the state after the last step that was made.
    Status advance_to(const Real& end)
    {
        Status status = aim(end) ? status_ : Status::invalid_input;
        if (!adaptive && status == Status::ok && way_.length > static_cast<Real>(most_steps) * h_)
            return Status::too_many_steps;
        for (const std::size_t limit = steps_ + most_steps; status == Status::ok && t_ != way_.end;)
            status = steps_ < limit ? one_step(limit - steps_) : Status::too_many_steps;
        return status;
    }

    /// Goes on from the state s at time t as a new integrator does; what was counted stays. Answers the new status().
    Status restart(const State& s, const Real& t)
    {
        work_ = work_.with(stepper_);
        stepper_.~Stepper();
        ::new (static_cast<void*>(&stepper_)) Stepper(method_);
        s_ = from_ = s;
        t_ = t_from_ = failed_at_ = origin_ = t;
        h_ = lost_ = lost_from_ = length_ = failed_length_ = Real(0);
        fresh_ = retry_ = imprecise_ = way_.bounded = false;
        return status_ = begin();
    }

    /// The state inside the last step, at its ends and, within the rounding of time, just beyond them; elsewhere, and
    /// behind a failed step, NaN.
    [[nodiscard]] State at(const Real& t)
    {
        const Real nearly = Real(4) * epsilon() * std::max<Real>(size(t_from_), size(t_)), theta = place_of(t);
        const bool stays = (t_from_ <= t && t <= t_) || (t_ <= t && t <= t_from_);
        if (t == t_ || (!stays && size(t - t_) <= nearly)) return s_;
        if (t == t_from_ || (!stays && size(t - t_from_) <= nearly)) return from_;
        if (!stays) return detail::no_state<Scalar>(s_);
        return theta <= Real(0) ? from_ : theta < Real(1) ? inside(theta) : s_;
    }

    [[nodiscard]] const Real& t() const noexcept { return t_; }
    [[nodiscard]] const State& state() const noexcept { return s_; }
    [[nodiscard]] const Real& t_before() const noexcept { return t_from_; } ///< the last step's start; t() if it failed
    [[nodiscard]] Status status() const noexcept { return status_; }        ///< of the start
    [[nodiscard]] const status_t<Scalar>& lanes() const noexcept { return lanes_; } ///< of each lane of a pack so far
    /// Where the last step that failed would have ended, or what ended it was met.
    [[nodiscard]] const Real& failed_at() const noexcept { return failed_at_; }
    [[nodiscard]] const M& model() const noexcept { return model_; }
    [[nodiscard]] std::size_t steps() const noexcept { return steps_; }
    [[nodiscard]] std::size_t rejected() const noexcept { return rejected_; }
    [[nodiscard]] std::size_t rhs_calls() const noexcept { return work_.with(stepper_).calls; }
    [[nodiscard]] std::size_t newton_iterations() const noexcept { return work_.with(stepper_).newton_iterations; }
    [[nodiscard]] std::size_t decompositions() const noexcept { return work_.with(stepper_).decompositions; }

  private:
    template <class, class, class, class>
    friend class detail::March;
    template <class, class, int, class>
    friend class detail::Abreast;

    using Attempt = detail::Attempt<Real>;
    static constexpr bool adaptive = Stepper::adaptive;
    static constexpr bool chooses_lengths = requires(Stepper stepper, Real h) { stepper.after_failure(h); };
    static Real epsilon() noexcept { return std::numeric_limits<Real>::epsilon(); }
    static Real size(const Real& x) noexcept { return detail::size_of(x); }

    Status begin()
    {
        if (t_ - t_ != Real(0) || !step_is_valid()) return Status::invalid_input;
        auto status = StatusOf<Scalar>::good();
        if constexpr (requires { s_[0]; }) status = detail::check_finite(s_);
        if constexpr (HasParameterStatus<M>) status = StatusOf<Scalar>::first(model_.parameter_status(), status);
        status = follow(StatusOf<Scalar>::first(status, accepted()), t_);
        if (is_pack<Scalar> || StatusOf<Scalar>::all_good(status))
            status = StatusOf<Scalar>::first(status, stepper_.begin(model_, t_, s_));
        if constexpr (adaptive)
            if (status == Status::ok && detail::is_below_rounding(method_.control(), s_))
                status = Status::step_too_small;
        if constexpr (adaptive && !chooses_lengths)
            controller_ = detail::Controller<Real>(method_.control(), Stepper::error_order, Real(Stepper::beta_share));
        return detail::settle<Scalar>(lanes_, status);
    }

    bool step_is_valid() noexcept
    {
        if constexpr (adaptive) {
            return method_.control().is_valid();
        } else {
            h_ = static_cast<Real>(detail::step_length(model_, method_));
            return h_ > Real(0) && h_ - h_ == Real(0);
        }
    }

    bool aim(const Real& end) ///< the next steps go there; false where it is no number
    {
        if (way_.bounded && end == way_.end) return true;
        const Real length = end - t_;
        if (length - length != Real(0)) return false;
        way_.aim(t_, end);
        if constexpr (!adaptive) way_.near = h_ + Real(8) * epsilon() * way_.reach;
        prepare(length);
        return true;
    }

    void prepare(const Real& most) ///< the first step's length, `most` being the way to go
    {
        if constexpr (adaptive) {
            if (h_ != Real(0) || most == Real(0) || status_ != Status::ok) return;
            const Real first = static_cast<Real>(method_.control().first_step);
            h_ = first > Real(0) ? first : size(stepper_.first_step(model_, t_, most, s_));
            if (!way_.bounded) way_.length = h_;
        }
    }

    Status one_step(std::size_t most = 1) ///< or `most` of them
    {
        if (status_ != Status::ok) return status_;
        Status status = Status::ok;
        do status = take(most, [] {});
        while (retry_ && status == Status::ok);
        if (status != Status::ok && fresh_) undo();
        return status;
    }

    /// An attempt at a step. It may ask for another one (`retry_`), and it may leave the domain: then it stands until
    /// `undo`, not counted, so that values inside it can be asked for. Of a fixed length, up to `most` steps are made
    /// that do not come near the end, and between() is called between two of them.
    template <class Between>
    [[gnu::always_inline]] Status take(std::size_t most, const Between& between)
    {
        Attempt next{};
        const Status refused = propose(next);
        if (refused != Status::ok) return refused;
        for (std::size_t left = next.last || adaptive ? 1 : way_.steps_inside(h_, t_, most);;) {
            const auto status = stepper_.attempt(model_, t_from_, from_, next.h, s_);
            const Status ending = conclude(status, next);
            if (adaptive || ending != Status::ok || --left == 0) return ending;
            between();
            open();
        }
    }

    /// What the stepper is to attempt next, from (t_from_, from_); not ok where there is no next step.
    [[gnu::always_inline]] Status propose(Attempt& next)
    {
        open();
        std::pair<Real, bool> length;
        if constexpr (adaptive)
            length = way_.next_of(h_, t_, static_cast<Real>(method_.control().max_step));
        else
            length = way_.next_of(h_, t_);
        // The last step goes from the time that is kept, rounding error and all.
        next = {length.second ? Real(length.first + lost_) : length.first, length.second};
        if constexpr (adaptive)
            if (!next.last && way_.is_lost(h_, t_)) return fail(Status::step_too_small, t_);
        if (!way_.bounded && !detail::is_finite_number(Real(t_ + next.h))) [[unlikely]]
            return fail(Status::non_finite, Real(t_ + next.h));
        return Status::ok;
    }

    /// Where it ends: a compensated sum of the times [Kahan 1965].
    [[gnu::always_inline]] Real end_of(const Attempt& made) const noexcept
    {
        if (made.last) [[unlikely]]
            return way_.end;
        return t_ + (made.h - lost_);
    }

    /// Takes an attempt that brought s_ and `status`.
    [[gnu::always_inline]] Status conclude(const status_t<Scalar>& status, const Attempt& made)
    {
        const Real t1 = end_of(made), lost = made.last ? Real(0) : Real((t1 - t_) - (made.h - lost_));
        if constexpr (adaptive) {
            const Status verdict = judge(status, made.h, t1);
            if (verdict != Status::ok) return fail(verdict, t1);
            if (retry_) return Status::ok;
        } else if constexpr (!is_pack<Scalar>) {
            const Status verdict = follow(status, t1);
            if (verdict != Status::ok)
                return fail(detail::loss_of_maximum(verdict, model_, t_from_, from_, made.h), t1);
        }
        t_ = t1;
        length_ = made.h;
        if constexpr (StaysOnGroups<M>) model_.stay_on_groups(from_, s_);
        const auto ending = accepted();
        if constexpr (is_pack<Scalar>) {
            const Status verdict = detail::settle<Scalar>(lanes_, follow(StatusOf<Scalar>::first(status, ending), t1));
            if (verdict != Status::ok) return fail(verdict, t1);
            detail::freeze<Scalar>(lanes_, from_, s_);
        }
        fresh_ = true;
        if constexpr (!is_pack<Scalar>)
            if (ending != Status::ok) return failed_at_ = t1, ending;
        ++steps_;
        lost_ = lost;
        return Status::ok;
    }

    /// The step before counts, and the next one begins where it ended.
    [[gnu::always_inline]] void open()
    {
        if (fresh_) stepper_.accept();
        fresh_ = false;
        from_ = s_;
        t_from_ = t_;
        lost_from_ = lost_;
    }

    /// What is asked at the start and behind every accepted step, at t_ and s_.
    [[gnu::always_inline]] status_t<Scalar> accepted() { return detail::domain_status(model_, t_, s_); }

    /// Where `status` is good and s_ inside the domain, a model that searches for something follows it to (t, s_).
    [[gnu::always_inline]] status_t<Scalar> follow(const status_t<Scalar>& status, const Real& t)
    {
        if constexpr (Follows<M>)
            if (detail::follows(model_)) return detail::followed(model_, status, t, s_);
        return status;
    }

    Status fail(Status reason, const Real& failed_at) noexcept
    {
        failed_at_ = failed_at;
        undo();
        if constexpr (adaptive) {
            // Its length says nothing of the steps that may be tried from here.
            h_ = failed_length_ = Real(0);
            way_.bounded = imprecise_ = retry_ = false;
        }
        return reason;
    }

    /// Back to the beginning of the step, which is then over.
    void undo() noexcept
    {
        s_ = from_;
        t_ = t_from_;
        fresh_ = false;
        if constexpr (requires { stepper_.forget(); }) stepper_.forget();
    }

    /// Accepts or rejects a step of an adaptive method and proposes the next length; not ok where there is none.
    Status judge(Status status, const Real& h, const Real& t1) noexcept requires(adaptive)
    {
        const Real error = status == Status::ok ? stepper_.error() : Real(0);
        if (status == Status::ok && error - error != Real(0)) status = Status::non_finite;
        const bool is_imprecise = status == Status::ok && error > Real(1);
        if (status == Status::ok && !is_imprecise) status = stepper_.finish(model_, t1, s_);
        if (!is_imprecise) status = follow(status, t1);
        retry_ = is_imprecise || status != Status::ok;
        if (!retry_) {
            imprecise_ = false;
            failed_length_ = Real(0);
            const Real asked = h_, length = size(h);
            h_ = lengths().after_accepted(length, error);
            // A step that an end cut short says nothing against the length that was asked for.
            if (length < asked && h_ < asked && !requires { Stepper::foresees; }) h_ = asked;
            return Status::ok;
        }
        s_ = from_;
        ++rejected_;
        if (is_imprecise) {
            imprecise_ = true;
            h_ = lengths().after_rejected(size(h), error);
            status = Status::step_too_small;
        } else {
            if (failed_length_ == Real(0)) failed_length_ = h;
            h_ = lengths().after_failure(size(h));
        }
        const Status verdict = creeping_.creeps(t_, way_.length, steps_, rejected_) ? status : size_verdict(status, t1);
        using std::sqrt;
        const Real ahead = sqrt(epsilon()) * way_.directed(way_.length);
        return is_imprecise ? verdict : detail::loss_of_maximum(verdict, model_, t_from_, from_, ahead);
    }

    auto& lengths() noexcept ///< whose lengths the next steps have
    {
        if constexpr (chooses_lengths)
            return stepper_;
        else
            return controller_;
    }

    /// `reason` where the next step would be lost in the rounding of time; left_domain in a run into the boundary.
    Status size_verdict(Status reason, const Real& t1) noexcept requires(adaptive)
    {
        if (!way_.is_lost(h_, t_)) return Status::ok;
        if constexpr (HasDomain<M>) {
            inner_ = s_ + failed_length_ * stepper_.derivative();
            if (reason != Status::step_too_small && detail::domain_status(model_, t1, inner_) != Status::ok)
                return Status::left_domain;
        }
        // Shorter steps were finite and failed by their error: the tolerance cannot be met.
        return reason == Status::non_finite && imprecise_ ? Status::step_too_small : reason;
    }

    /// Where t is in the last step, from t_from_ - lost_from_ (0) to t_ - lost_ (1); the time at `length` in it.
    [[nodiscard]] Real place_of(const Real& t) const noexcept { return ((t - t_from_) + lost_from_) / length_; }
    [[nodiscard]] Real time_behind(const Real& length) const noexcept { return t_from_ + (length - lost_from_); }
    /// What is nearer to the end of a step is the end: as little as the errors of all steps so far.
    Real slack() const noexcept { return Real(4) * epsilon() * std::max<Real>(size(t_ - origin_), size(length_)); }

    /// The state at the place theta of the last step, or beside its end by the rounding of time; where it cannot be
    /// computed, on the chord of the step.
    const State& inside(const Real& theta) noexcept
    {
        const auto status = stepper_.interpolate(model_, t_from_, from_, length_, s_, theta, inner_);
        if (!is_pack<Scalar> && !StatusOf<Scalar>::all_good(status)) detail::go_straight<M>(from_, s_, theta, inner_);
        if constexpr (StaysOnGroups<M>) model_.stay_on_groups(from_, inner_);
        detail::freeze<Scalar>(lanes_, from_, inner_);
        return inner_;
    }

    M model_;
    Method method_;
    Stepper stepper_;
    State s_, from_, inner_;               ///< at the end and at the beginning of the last step; a value inside it
    Real t_, t_from_, failed_at_, origin_; ///< origin_: where the first step began
    detail::Way<Real> way_;
    Real lost_ = Real(0), lost_from_ = Real(0), length_ = Real(0); ///< t_ - lost_ is t_from_ - lost_from_ + length_
    Real h_ = Real(0);             ///< positive: the length that the method or the controller asks for
    Real failed_length_ = Real(0); ///< of the first of a series of steps that could not be evaluated
    detail::Controller<Real> controller_{StepControl{}, 5, Real(0)};
    detail::CreepingWatch<Real> creeping_;
    std::size_t steps_ = 0, rejected_ = 0;
    status_t<Scalar> lanes_ = StatusOf<Scalar>::good();
    Status status_ = Status::ok;
    detail::Work work_;      ///< before the last restart
    bool fresh_ = false;     ///< the stepper has not been told yet that the last step was accepted
    bool retry_ = false;     ///< the last attempt was rejected
    bool imprecise_ = false; ///< since the last accepted step, one was rejected by its error
};

} // namespace lagen
