// SPDX-License-Identifier: MIT
/// The march from the start of an interval to its end, on an Integrator: rows, events, the boundary of the domain,
/// dense solutions, caps. Nothing in a step allocates; rows, solutions and lists of events found grow outside of it.
#pragma once

#include "lagen/integrate/integrator.hpp"
#include "lagen/integrate/watch_events.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace lagen::detail {

/// `Asked` is Options<M>, or NoOptions<M> where nothing is asked for: what rows, events and solutions take is then left
/// out by the compiler.
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
    static constexpr int nodes = (Stepper::dense_order + 3) / 2;
    static constexpr bool asks = std::is_same_v<Asked, Options<M>>;
    static constexpr bool can_jump = asks && RightHandSide<M> && !is_pack<Scalar> && std::is_copy_assignable_v<Stepper>;
    static constexpr bool sums = requires(Observer observer, Real t, const State& (*inside)(const Real&))
    {
        observer.template sum<nodes>(t, t, inside);
    };

    March(const M& model, const State& s, Interval<Real> span, const Method& method, const Asked& options,
          Observer& observer)
        : steps_(model, s, span.start, method), span_(span), options_(options), observer_(observer),
          watch_(steps_.model(), options.events), last_jumps_(options.events.size()),
          forward_(!(span.end - span.start < Real(0))),
          looks_(!options.at.empty() || !options.events.empty() || options.dense),
          limit_(options.has_company() ? 0 : options.max_steps)
    {
    }

    /// Whether some event asks for a jump.
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
        if (length - length != Real(0) || !watch_.is_valid() || !are_in_order(options_.at, forward_))
            return Status::invalid_input;
        if (is_pack<Scalar> && !watch_.empty()) return Status::invalid_input;
        if (!can_jump && jumps(options_)) return Status::invalid_input;
        if (!moves_by_sums<M> && options_.dense) return Status::invalid_input;
        if (steps_.status() != Status::ok) return steps_.status();
        if constexpr (asks)
            if (!watch_.empty()) watch_.begin(steps_.t(), steps_.state(), length), parts_.reserve(16);
        steps_.aim(span_.end);
        if constexpr (asks && moves_by_sums<M>)
            if (options_.dense) run_.solution.begin(steps_.t(), steps_.state(), Stepper::dense_order);
        while (row_ < options_.at.size() && is_after(span_.start, options_.at[row_])) ++row_;
        if constexpr (asks) rows_until(span_.start, [&](Real) { return &steps_.state(); });
        show();
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
        if constexpr (asks || HasDomain<M>) ending = commit(ending);
        show();
        return ending;
    }

    // ---- what an accepted step brings ----

    /// Boundary, events, rows; then the state moves to where the run ends or jumps, if that is inside the step.
    Status commit(Status ending)
    {
        Real theta = Real(1);
        const Real t0 = steps_.t_from_, h = steps_.t_ - t0;
        const auto at = [&](const Real& x) { return inside(x, t0, h); };
        if constexpr (HasDomain<M> && !is_pack<Scalar>) {
            if (ending == Status::left_domain) {
                const auto edge = locate_boundary(Real(0), Real(1), theta_width(t0, h), [&](Real x) {
                    const auto [t, s] = at(x);
                    return domain_status(steps_.model_, t, *s) == Status::ok;
                });
                theta = edge.before;
                steps_.failed_at_ = t0 + edge.after * h;
            }
        }
        if (ending != Status::ok) ++steps_.steps_;
        bool jumps = false, stops = false;
        const Real width = theta_width(t0, h);
        if constexpr (!asks) {
        } else if (!watch_.empty()) {
            const bool known = find_parts(theta, h);
            refined_.theta = Real(-1);
            for (const auto& crossed : watch_.look(parts_, width, Stepper::adaptive && !known, at)) {
                jumps = jumps || options_.events[crossed.request].jump;
                stops = stops || crossed.stop;
            }
            if (stops || jumps) theta = watch_.crossed().back().theta;
            if constexpr (can_jump)
                if (jumps && !stops) refine(theta, t0, h);
            for (const auto& crossed : watch_.crossed()) {
                const auto [t, s] = at(crossed.theta);
                run_.events.push_back({crossed.request, t, *s, *s});
                stops = stops || crossed.stop;
            }
        }
        move(theta, t0, h);
        if (stops) return Status::stopped_by_event;
        if constexpr (can_jump)
            if (jumps) return jump(theta, h, width);
        return ending;
    }

    /// A run goes on from the state at a jump, and values inside a step are less precise than steps, times less than
    /// their lengths: a step is made that ends where the function of the event is zero by it.
    void refine(const Real& theta, const Real& t0, const Real& h)
    {
        Stepper stepper = steps_.stepper_;
        const std::size_t r = watch_.crossed().back().request;
        Real length = theta * h, most = size(length) / Real(2);
        bool finer = true;
        for (int round = 0; round < 2 && finer; ++round) {
            refined_.s = steps_.from_;
            finer = stepper.attempt(steps_.model_, t0, steps_.from_, length, refined_.s) == Status::ok;
            if constexpr (StaysOnGroups<M>) steps_.model_.stay_on_groups(steps_.from_, refined_.s);
            refined_.t = t0 + length;
            const Real missing = finer ? watch_.time_to_zero(r, refined_.t, refined_.s, h) : h;
            finer = size(missing) <= most;
            most = std::max<Real>(size(missing) / Real(16), Real(8) * epsilon() * size(length));
            if (round == 0) length += missing;
        }
        steps_.work_.calls += stepper.calls() - steps_.stepper_.calls();
        if (finer) refined_.theta = theta;
        const auto [t, s] = inside(theta, t0, h);
        watch_.settle(t, *s, theta);
    }

    /// Behind all jumps of this instant, in the order of the requests, the run goes on as from a start.
    Status jump(const Real& theta, const Real& h, const Real& width)
    {
        const Real t = steps_.t_;
        const State from = steps_.s_;
        State to = from;
        steps_.failed_at_ = t;
        for (const auto& crossed : watch_.crossed()) {
            const auto& request = options_.events[crossed.request];
            if (!request.jump) continue;
            auto& [count, last] = last_jumps_[crossed.request];
            const bool fast = size(t - last) <= Real(8) * epsilon() * size(t) || watch_.returns(crossed, t, from, h);
            if (crossed.at_once || (count++ > 0 && fast)) return Status::zeno;
            last = t;
            to = request.jump(t, to);
        }
        if (++jumps_ > options_.max_jumps) return Status::too_many_steps;
        show();
        for (auto found = run_.events.rbegin(); found != run_.events.rend() && found->t == t; ++found)
            found->after = to;
        if constexpr (requires { observer_.jump(t, from, to); }) observer_.jump(t, from, to);
        if constexpr (moves_by_sums<M>)
            if (options_.dense) run_.solution.jump(to);
        const Status status = steps_.restart(to, t);
        if (status != Status::ok) return steps_.s_ = from, status;
        steps_.aim(span_.end);
        if (Stepper::adaptive && steps_.h_ > Real(0)) steps_.h_ = std::max<Real>(steps_.h_, steps_.way_.shortest(t));
        watch_.restart(t, from, to, h, theta, width);
        return status;
    }

    /// For an observer that integrates along the motion: the part of the step that counts, from t0 on and theta h long,
    /// the state at each fraction x of it, and how many of Gauss' nodes an integral needs to have the order of the
    /// method. A collocation polynomial gives integrals over whole steps that order too.
    void sum(const Real& theta, const Real& t0, const Real& h)
    {
        if constexpr (sums)
            observer_.template sum<nodes>(t0, Real(theta * h), [&](const Real& x) -> const State& {
                if constexpr (requires { steps_.stepper_.polynomial(x, steps_.inner_); })
                    if (theta == Real(1)) {
                        steps_.stepper_.polynomial(x, steps_.inner_);
                        return steps_.inner_ += steps_.from_;
                    }
                return *inside(Real(x * theta), t0, h).second;
            });
    }

    /// The ends of the parts of (0, theta] in which events are looked for: where the stepper knows between which times
    /// they change their signs, those, and true; else equal ones.
    bool find_parts(const Real& theta, const Real& h)
    {
        parts_.clear();
        bool known = false;
        if constexpr (requires(void (*found)(Real)) { steps_.stepper_.split(h, theta, found); })
            known = watch_.all_named() &&
                    steps_.stepper_.split(h, theta, [this](const Real& end) { parts_.push_back(end); });
        for (int piece = 1; piece < pieces && !known; ++piece) parts_.push_back(theta * Real(piece) / Real(pieces));
        if (known) std::sort(parts_.begin(), parts_.end());
        if (parts_.empty() || parts_.back() != theta) parts_.push_back(theta);
        return known;
    }

    Real theta_width(const Real& t0, const Real& h) const noexcept
    {
        return std::max<Real>(Real(2) * epsilon(), epsilon() * std::max<Real>(size(t0), size(t0 + h)) / size(h));
    }

    Real time_at(const Real& theta, const Real& t0, const Real& h) const noexcept
    {
        return theta == Real(1) ? steps_.t_ : theta == refined_.theta ? refined_.t : Real(t0 + theta * h);
    }

    std::pair<Real, const State*> inside(const Real& theta, const Real& t0, const Real& h) noexcept
    {
        const Real t = time_at(theta, t0, h);
        if (theta == Real(1)) return {t, &steps_.s_};
        if (theta == Real(0)) return {t, &steps_.from_};
        return {t, theta == refined_.theta ? &refined_.s : &steps_.inside(theta)};
    }

    void move(const Real& theta, const Real& t0, const Real& h)
    {
        const Real end = time_at(theta, t0, h);
        sum(theta, t0, h);
        const auto at = [&](const Real& time) {
            // A row within rounding of the step's end is the step's end.
            Real x = (time - t0) / h;
            if (x > theta || size(time - end) <= Real(4) * epsilon() * steps_.way_.reach) x = theta;
            return inside(x, t0, h).second;
        };
        for (const auto& crossed : watch_.crossed()) {
            if (!options_.events[crossed.request].row) continue;
            const Real time = time_at(crossed.theta, t0, h);
            rows_until(time, at);
            put_row(time, *inside(crossed.theta, t0, h).second);
        }
        rows_until(end, at);
        if constexpr (moves_by_sums<M>)
            if (options_.dense && theta > Real(0))
                run_.solution.add(end, [&](const Real& x) { return *inside(Real(x * theta), t0, h).second; });
        if (theta == Real(1)) return;
        const State last = *inside(theta, t0, h).second;
        steps_.s_ = last;
        steps_.t_ = end;
    }

    // ---- rows ----

    static Real size(const Real& x) noexcept { return Steps::size(x); }
    bool is_after(const Real& a, const Real& b) const noexcept { return forward_ ? a > b : a < b; }

    /// Rows at the times up to `end`, rounding included.
    template <class At>
    void rows_until(const Real& end, const At& at)
    {
        const Real slack = Real(4) * epsilon() * steps_.way_.reach;
        while (row_ < options_.at.size()) {
            const Real time = options_.at[row_];
            if (is_after(time, end) && size(time - end) > slack) return;
            if (is_after(time, span_.end)) return;
            put_row(time, *at(time));
            ++row_;
        }
    }

    void put_row(const Real& time, const State& state)
    {
        if constexpr (requires { observer_.row(time, state); }) {
            observer_.row(time, state);
        } else {
            run_.times.push_back(time);
            run_.states.push_back(state);
        }
    }

    Steps steps_;
    Interval<Real> span_;
    const Asked& options_;
    Observer& observer_;
    std::conditional_t<asks, EventWatch<M>, NoOptions<M>> watch_;
    Run<M> run_;
    std::vector<Real> parts_; ///< of a step
    struct {
        Real theta = Real(-1), t;
        State s;
    } refined_; ///< of the last step, at a jump
    std::size_t row_ = 0;
    std::size_t jumps_ = 0;
    std::vector<std::pair<std::size_t, Real>> last_jumps_; ///< of each request: how many there were, and when
    bool forward_;
    bool looks_;        ///< into every step: there are integrals, rows, events or a solution
    std::size_t limit_; ///< tries up to which nothing has to be looked at
};

} // namespace lagen::detail
