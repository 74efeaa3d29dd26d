// SPDX-License-Identifier: MIT
/// The march from the start of an interval to its end, on an Integrator: rows, events, the boundary of the domain,
/// dense solutions, caps. Nothing in a step allocates; rows, solutions and lists of events found grow outside of it.
#pragma once

#include "lagen/integrate/instant.hpp"
#include "lagen/integrate/integrator.hpp"
#include "lagen/integrate/options.hpp"
#include "lagen/integrate/watch_events.hpp"
#include "lagen/lanes/lanes.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace lagen::detail {

// The rows of a run, in the direction of the run: to the observer where it takes them, else into the result.

template <class M, class Observer>
class Rows {
  public:
    using Real = real_t<typename M::Scalar>;
    using State = typename M::State;

    Rows(std::span<const Real> at, const Interval<Real>& span, Observer& observer)
        : at_(at), span_(span), observer_(observer), forward_(!(span.end - span.start < Real(0)))
    {
    }

    /// Those asked for are in the direction of the run, and none of them is NaN.
    [[nodiscard]] bool are_in_order() const noexcept
    {
        for (std::size_t k = 0; k < at_.size(); ++k) {
            if (at_[k] != at_[k]) return false;
            if (k > 0 && is_after(at_[k - 1], at_[k])) return false;
        }
        return true;
    }

    /// None before the start.
    void begin() noexcept
    {
        while (next_ < at_.size() && is_after(span_.start, at_[next_])) ++next_;
    }

    /// Those at times up to `end`, and behind it by at most `slack`; at(time) points to the state there.
    template <class At>
    void until(const Real& end, const Real& slack, Run<M>& run, const At& at)
    {
        for (; next_ < at_.size(); ++next_) {
            const Real time = at_[next_];
            if (is_after(time, end) && size_of(Real(time - end)) > slack) return;
            if (is_after(time, span_.end)) return;
            put(time, *at(time), run);
        }
    }

    void put(const Real& time, const State& state, Run<M>& run)
    {
        if constexpr (requires { observer_.row(time, state); }) {
            observer_.row(time, state);
        } else {
            run.times.push_back(time);
            run.states.push_back(state);
        }
    }

  private:
    [[nodiscard]] bool is_after(const Real& a, const Real& b) const noexcept { return forward_ ? a > b : a < b; }

    std::span<const Real> at_;
    Interval<Real> span_;
    Observer& observer_;
    bool forward_;
    std::size_t next_ = 0;
};

/// `Asked` is Options<M>, or NoOptions<M>: then nothing is compiled of rows, events and solutions.
template <class M, class Method, class Observer, class Asked>
class March {
  public:
    using Steps = Integrator<M, Method>;
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    using Stepper = typename Steps::Stepper;
    static Real epsilon() noexcept { return std::numeric_limits<Real>::epsilon(); }
    /// Adaptive steps are long and their interpolants cheap: events are looked for in so many pieces of each.
    static constexpr int pieces = Stepper::adaptive ? 4 : 1;
    static constexpr bool asks = std::is_same_v<Asked, Options<M>>;
    static constexpr bool can_jump = asks && RightHandSide<M> && !is_pack<Scalar> && std::is_copy_assignable_v<Stepper>;
    static constexpr bool may_sum = requires(Observer observer, Real t, const State& (*inside)(const Real&))
    {
        observer.sum(std::size_t{1}, t, t, inside);
    };

    March(const M& model, const State& s, Interval<Real> span, const Method& method, const Asked& options,
          Observer& observer)
        : steps_(model, s, span.start, method), span_(span), options_(options), observer_(observer),
          rows_(options.at, span, observer), watch_(steps_.model(), options.events, zero_tolerance<Real>(method)),
          instant_(steps_.model(), options.events, zero_tolerance<Real>(method)), last_jumps_(options.events.size()),
          looks_(sums() || !options.at.empty() || !options.events.empty() || options.dense),
          limit_(options.has_company() ? 0 : options.max_steps)
    {
    }

    /// True where some event asks for a jump.
    static bool jumps(const Asked& options)
    {
        return std::any_of(options.events.begin(), options.events.end(), [](const auto& each) { return !!each.jump; });
    }

    Run<M> run()
    {
        Status status = begin();
        while (goes_on(status)) status = steps();
        return finish(status);
    }

  private:
    template <class, class, int, class>
    friend class Abreast;

    static Real size(const Real& x) noexcept { return Steps::size(x); }

    /// Is there another step to make, where the last one ended with `status`?
    bool goes_on(Status& status)
    {
        if (status == Status::ok && steps_.t_ != span_.end) status = interruption();
        return status == Status::ok && steps_.t_ != span_.end;
    }

    Run<M> finish(Status status)
    {
        run_.t = steps_.t();
        run_.state = steps_.state();
        run_.steps = steps_.steps();
        run_.rejected = steps_.rejected();
        run_.rhs_calls = steps_.rhs_calls();
        run_.newton_iterations = steps_.newton_iterations();
        run_.decompositions = steps_.decompositions();
        run_.failed_at = is_success(status) ? run_.t : steps_.failed_at();
        run_.outcome = status;
        if constexpr (is_pack<Scalar>) {
            run_.lanes = steps_.lanes();
            for (Status lane : run_.lanes.lanes)
                if (run_.outcome == Status::ok) run_.outcome = lane;
        } else {
            run_.lanes = status;
        }
        return std::move(run_);
    }

    Status begin()
    {
        const Real length = span_.end - span_.start;
        if (length - length != Real(0) || !watch_.is_valid() || !rows_.are_in_order()) return Status::invalid_input;
        if ((is_pack<Scalar> && !watch_.empty()) || (!can_jump && jumps(options_))) return Status::invalid_input;
        if (!moves_by_sums<M> && options_.dense) return Status::invalid_input;
        if (steps_.status() != Status::ok) return steps_.status();
        steps_.aim(span_.end);
        if constexpr (asks && moves_by_sums<M>)
            if (options_.dense) run_.solution.begin(steps_.t(), steps_.state(), dense_order_of(steps_.stepper_));
        if constexpr (asks)
            rows_.begin(), rows_.until(span_.start, Real(0), run_, [&](Real) { return &steps_.state(); });
        show();
        if constexpr (asks) return watch_.empty() ? Status::ok : begin_events(length);
        return Status::ok;
    }

    /// The start of a run of this signed length: requests with jumps may happen there.
    Status begin_events(const Real& length)
    {
        using std::sqrt;
        const Real t = steps_.t_, h = sqrt(epsilon()) * length;
        parts_.reserve(16);
        watch_.begin(t, steps_.s_, h, options_.continues != nullptr);
        if (length == Real(0)) return Status::ok;
        instant_.begin(t, steps_.s_, h);
        for (std::size_t r = 0; r < options_.events.size(); ++r)
            if (instant_.is_passed_over(r)) run_.starts_on.push_back(r);
        if (options_.continues != nullptr)
            for (const auto& found : options_.continues->events)
                if (found.t == t) instant_.leave_out(found.request);
        if constexpr (can_jump)
            if (instant_.is_due()) return land(h, Real(0), epsilon(), steps_.s_);
        return Status::ok;
    }

    void show()
    {
        if constexpr (requires { observer_(steps_.t(), steps_.state()); }) observer_(steps_.t(), steps_.state());
    }

    Status interruption()
    {
        const std::size_t tried = steps_.steps() + steps_.rejected();
        if (tried < limit_) return Status::ok;
        steps_.failed_at_ = steps_.t_;
        if (options_.is_cancelled()) return Status::interrupted;
        if (tried >= options_.max_steps) return Status::too_many_steps;
        if (options_.progress && tried % 256 == 255)
            options_.progress(
                static_cast<double>(plain_number<Real>((steps_.t() - span_.start) / (span_.end - span_.start))));
        return Status::ok;
    }

    /// How many steps may be made before something has to be looked at; of fixed length near the end, one.
    [[nodiscard]] std::size_t unseen_steps() const noexcept
    {
        const std::size_t tried = steps_.steps_ + steps_.rejected_;
        const std::size_t most = looks_ || tried >= limit_ ? 1 : limit_ - tried;
        return Stepper::adaptive ? most : steps_.way_.steps_inside(steps_.h_, steps_.t_, most);
    }

    /// Steps until something has to be looked at. The loop has no other way on than accepted steps, so that a compiler
    /// takes out of it what is the same in all of them.
    Status steps()
    {
        for (;;) {
            const std::size_t tried = steps_.steps_ + steps_.rejected_;
            const std::size_t most = looks_ || tried >= limit_ ? 1 : limit_ - tried;
            const Status ending = steps_.take(most, [&] { show(); });
            if (!steps_.fresh_) return ending;
            if (ending != Status::ok || looks_) return look(ending);
            show();
            if (steps_.t_ == span_.end || steps_.steps_ + steps_.rejected_ >= limit_) return Status::ok;
        }
    }

    /// The same of one step that is attempted elsewhere.
    Status conclude(const status_t<Scalar>& status, const typename Steps::Attempt& made)
    {
        const Status ending = steps_.conclude(status, made);
        if (!steps_.fresh_) return ending;
        if (ending != Status::ok || looks_) return look(ending);
        show();
        return Status::ok;
    }

    Status look(Status ending)
    {
        if constexpr (asks || HasDomain<M>) {
            if (ending == Status::ok && watch_.empty())
                move(Real(1), steps_.length_);
            else
                ending = commit(ending);
        }
        show();
        return ending;
    }

    // ---- what an accepted step brings ----

    /// Boundary, events, rows; then the state moves to where the run ends or jumps, if that is inside the step.
    Status commit(Status ending)
    {
        Real theta = Real(1);
        const Real h = steps_.length_, width = theta_width(h);
        const auto at = [&](const Real& x) { return inside(x, h); };
        if constexpr (HasDomain<M> && !is_pack<Scalar>) {
            if (ending == Status::left_domain) {
                const auto edge = locate_boundary(Real(0), Real(1), width, [&](Real x) {
                    const auto [t, s] = at(x);
                    return domain_status(steps_.model_, t, *s) == Status::ok;
                });
                theta = edge.before;
                steps_.failed_at_ = steps_.time_behind(edge.after * h);
            }
        }
        if (ending != Status::ok) ++steps_.steps_;
        bool jumps = false, stops = false;
        if constexpr (!asks) {
        } else if (!watch_.empty()) {
            const bool known = watch_.find_parts(steps_.stepper_, h, theta, pieces, parts_);
            refined_.theta = Real(-1);
            for (const auto& crossed : watch_.look(parts_, width, h, Stepper::adaptive && !known, at)) {
                jumps = jumps || options_.events[crossed.request].jump;
                stops = stops || crossed.stop;
            }
            if (stops || jumps) theta = watch_.crossed().back().theta;
            if constexpr (can_jump)
                if (jumps && !stops) refine(theta, h);
            for (const auto& crossed : watch_.crossed()) {
                const auto [t, s] = at(crossed.theta);
                run_.events.push_back({crossed.request, t, *s, *s});
                stops = stops || crossed.stop;
            }
        }
        move(theta, h);
        if (stops) return Status::stopped_by_event;
        if constexpr (can_jump)
            if (jumps) return jump(theta, h, width);
        return ending;
    }

    /// A run goes on from the state at a jump, and values inside a step are less precise than steps, times less than
    /// their lengths: a step is made that ends where the function of the event is zero by it.
    void refine(const Real& theta, const Real& h)
    {
        if (theta == Real(0)) return;
        Stepper stepper = steps_.stepper_;
        const std::size_t r = watch_.crossed().back().request;
        Real length = theta * h, most = size(length) / Real(2);
        bool finer = true;
        for (int round = 0; round < 2 && finer; ++round) {
            refined_.s = steps_.from_;
            finer = stepper.attempt(steps_.model_, steps_.t_from_, steps_.from_, length, refined_.s) == Status::ok;
            if constexpr (StaysOnGroups<M>) steps_.model_.stay_on_groups(steps_.from_, refined_.s);
            refined_.t = steps_.time_behind(length);
            refined_.length = length;
            const Real missing = finer ? watch_.time_to_zero(r, refined_.t, refined_.s, h) : h;
            finer = size(missing) <= most;
            most = std::max<Real>(size(missing) / Real(16), Real(8) * epsilon() * size(length));
            if (round == 0) length += missing;
        }
        steps_.work_.calls += stepper.calls() - steps_.stepper_.calls();
        if (finer) refined_.theta = theta;
        const auto [t, s] = inside(theta, h);
        watch_.settle(t, *s, theta);
    }

    /// Makes the jumps of the requests that have crossed at theta of the last step, in their order.
    Status jump(const Real& theta, const Real& h, const Real& width)
    {
        const Real t = steps_.t_;
        const State from = steps_.s_;
        State to = from;
        steps_.failed_at_ = t;
        instant_.arrive(t, from, h);
        for (const auto& crossed : watch_.crossed()) {
            const auto& request = options_.events[crossed.request];
            if (!request.jump) continue;
            auto& [count, last] = last_jumps_[crossed.request];
            const bool fast = size(t - last) <= Real(8) * epsilon() * size(t) || watch_.returns(crossed, t, from, h);
            if (crossed.at_once || (count++ > 0 && fast)) return Status::zeno;
            last = t;
            to = request.jump(t, to);
            instant_.jumped(crossed.request, t, to, h);
        }
        return land(h, theta, width, to);
    }

    /// Behind all jumps of this instant the run goes on as from a start, `to` being the state behind the first ones.
    Status land(const Real& h, const Real& theta, const Real& width, State to)
    {
        const Real t = steps_.t_, lost = steps_.lost_, origin = steps_.origin_;
        const State from = steps_.s_;
        const std::size_t found_before = run_.events.size();
        steps_.failed_at_ = t;
        const Status rounds = instant_.take_rounds(t, h, to, [&](std::size_t r) {
            run_.events.push_back({r, t, to, to});
            if (options_.events[r].row) rows_.put(t, to, run_);
            ++last_jumps_[r].first, last_jumps_[r].second = t;
            return watch_.stops(r);
        });
        if (rounds == Status::zeno) return run_.events.resize(found_before, {0, t, from, from}), rounds;
        if (++jumps_ > options_.max_jumps) return Status::too_many_steps;
        show();
        for (auto found = run_.events.rbegin(); found != run_.events.rend() && found->t == t; ++found)
            found->after = to;
        if constexpr (requires { observer_.jump(t, from, to); }) observer_.jump(t, from, to);
        if constexpr (moves_by_sums<M>)
            if (options_.dense) run_.solution.jump(to);
        const Status status = steps_.restart(to, t);
        if (status != Status::ok) return steps_.s_ = from, status;
        steps_.lost_ = lost;
        steps_.origin_ = origin;
        if (rounds != Status::ok) return rounds;
        steps_.aim(span_.end);
        if (Stepper::adaptive && steps_.h_ > Real(0)) steps_.h_ = std::max<Real>(steps_.h_, steps_.way_.shortest(t));
        watch_.restart(instant_, t, from, to, h, theta, width);
        return status;
    }

    /// Does the observer integrate along the motion? It may say that it does not.
    [[nodiscard]] bool sums() const noexcept
    {
        if constexpr (requires { observer_.sums(); }) return observer_.sums();
        return may_sum;
    }

    /// For an observer that does: the part of the step that counts, which is theta h long, the state at each fraction x
    /// of it, and how many of Gauss' nodes an integral needs to have the order of the method. A collocation polynomial
    /// gives integrals over whole steps that order too.
    void sum(const Real& theta, const Real& h)
    {
        if constexpr (may_sum) {
            if (!sums()) return;
            const auto nodes = (dense_order_of(steps_.stepper_) + 3) / 2;
            observer_.sum(nodes, steps_.t_from_, Real(theta * h), [&](const Real& x) -> const State& {
                if constexpr (requires { steps_.stepper_.polynomial(x, steps_.inner_); })
                    if (theta == Real(1) && steps_.stepper_.polynomial(x, steps_.inner_))
                        return steps_.inner_ += steps_.from_;
                return *inside(Real(x * theta), h).second;
            });
        }
    }

    Real theta_width(const Real& h) const noexcept
    {
        return std::max<Real>(Real(2) * epsilon(), steps_.slack() / (Real(4) * size(h)));
    }

    Real length_to(const Real& theta, const Real& h) const noexcept
    {
        return theta == refined_.theta ? refined_.length : Real(theta * h);
    }
    Real time_at(const Real& theta, const Real& h) const noexcept
    {
        return theta == Real(1) ? steps_.t_ : steps_.time_behind(length_to(theta, h));
    }

    std::pair<Real, const State*> inside(const Real& theta, const Real& h) noexcept
    {
        const Real t = time_at(theta, h);
        if (theta == Real(1)) return {t, &steps_.s_};
        if (theta == Real(0)) return {t, &steps_.from_};
        return {t, theta == refined_.theta ? &refined_.s : &steps_.inside(theta)};
    }

    void move(const Real& theta, const Real& h)
    {
        const Real end = time_at(theta, h);
        sum(theta, h);
        const auto at = [&](const Real& time) {
            // A row within rounding of where the motion ends is there.
            Real x = steps_.place_of(time);
            if ((theta < Real(1) && x > theta) || size((x - theta) * h) <= steps_.slack()) x = theta;
            return inside(x, h).second;
        };
        for (const auto& crossed : watch_.crossed()) {
            if (!options_.events[crossed.request].row) continue;
            const Real time = time_at(crossed.theta, h);
            rows_.until(time, steps_.slack(), run_, at);
            rows_.put(time, *inside(crossed.theta, h).second, run_);
        }
        rows_.until(end, steps_.slack(), run_, at);
        const Real length = length_to(theta, h);
        if constexpr (moves_by_sums<M>)
            if (options_.dense && theta > Real(0))
                run_.solution.add(end, length, steps_.lost_from_,
                                  [&](const Real& x) { return *inside(Real(x * theta), h).second; });
        if (theta == Real(1)) return;
        const State last = *inside(theta, h).second;
        steps_.s_ = last;
        steps_.t_ = end;
        steps_.lost_ = (end - steps_.t_from_) - (length - steps_.lost_from_);
    }

    Steps steps_;
    Interval<Real> span_;
    const Asked& options_;
    Observer& observer_;
    Rows<M, Observer> rows_;
    std::conditional_t<asks, EventWatch<M>, NoOptions<M>> watch_;
    std::conditional_t<asks, Instant<M>, NoOptions<M>> instant_;
    Run<M> run_;
    std::vector<Real> parts_; ///< of a step
    struct {
        Real theta = Real(-1), t, length;
        State s;
    } refined_; ///< of the last step, at a jump
    std::size_t jumps_ = 0;
    std::vector<std::pair<std::size_t, Real>> last_jumps_; ///< of each request: how many there were, and when
    bool looks_;        ///< into every step: there are integrals, rows, events or a solution
    std::size_t limit_; ///< tries up to which nothing has to be looked at
};

} // namespace lagen::detail
