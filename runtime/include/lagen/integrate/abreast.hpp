// SPDX-License-Identifier: MIT
/// Trajectories abreast: each on a lane of a pack, with a time, a step and an end of its own. The right-hand sides and
/// the sums of a step are computed for all lanes at once. Everything else (whether the step counts, the next length,
/// rows, events, the boundary of the domain, statuses) is the march of `integrate`, one a lane, so that a trajectory
/// has the bits that `integrate` gives it, whatever goes on in the other lanes: on processors with fused
/// multiplication where the compiler does not contract (-ffp-contract=off), elsewhere always. A lane whose trajectory
/// has ended takes the next one.
#pragma once

#include "lagen/integrate/march.hpp"
#include "lagen/integrate/shared_steps.hpp"
#include "lagen/series.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace lagen::detail {

/// A stepper whose lengths come from the state alone says so; that of a lane says the same.
template <class Own>
struct ForeseesAs {
};
template <class Own>
requires requires
{
    Own::foresees;
}
struct ForeseesAs<Own> {
    static constexpr bool foresees = true;
};

/// The stepper of one trajectory on a lane: see integrate/stepper.hpp for what is asked of a stepper.
template <class M, class Method, int N>
class LaneStepper : public ForeseesAs<typename Method::template Stepper<M>> {
    using Own = typename Method::template Stepper<M>;
    using Shared = SharedSteps<M, Method, N>;

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = Own::adaptive;
    static constexpr bool chooses_lengths = requires(Own own, Real h) { own.after_failure(h); };
    static constexpr int dense_order = Own::dense_order;
    static constexpr int error_order = [] {
        if constexpr (adaptive) return Own::error_order;
        return 0;
    }();
    static constexpr double beta_share = [] {
        if constexpr (adaptive) return Own::beta_share;
        return 0.0;
    }();

    template <class OnLane>
    explicit LaneStepper(const OnLane& method) noexcept : own_(method), shared_(*method.shared), lane_(method.lane)
    {
        if constexpr (adaptive) controller_ = Controller<Real>(method.control(), error_order, Real(beta_share));
    }

    Status begin(const M& model, Real t, const State& s) noexcept { return own_.begin(model, t, s); }
    /// The trajectory takes its lane.
    void enter(const M& model, const State& s) noexcept
    {
        shared_.adopt(lane_, model, s, own_, controller_.exponents());
    }
    [[nodiscard]] bool suits() const noexcept { return shared_.stepper.suits(own_); }

    [[nodiscard]] Real first_step(const M& model, Real t, Real length, const State& s) noexcept
    {
        return own_.first_step(model, t, length, s);
    }
    /// An attempt was made; s1 is where it leads.
    Status attempted(State& s1) noexcept
    {
        calls_ += shared_.calls;
        has_slopes_ = false;
        for (Eigen::Index i = 0; i < s1.size(); ++i) s1[i] = shared_.to[i][lane_];
        return shared_.status[lane_];
    }
    /// So many steps were made, and count.
    void made(std::size_t steps, State& s) noexcept
    {
        calls_ += steps * shared_.calls;
        for (Eigen::Index i = 0; i < s.size(); ++i) s[i] = shared_.from[i][lane_];
    }
    [[nodiscard]] Real error() const noexcept { return shared_.error[lane_]; }
    Status finish(const M&, Real, const State&) noexcept
    {
        calls_ += shared_.calls_at_end;
        return shared_.finished[lane_];
    }
    // The lengths are those that the method chooses itself, or its controller, from powers that all lanes share.
    [[nodiscard]] Real after_accepted(Real h, Real error) noexcept
    {
        if constexpr (chooses_lengths) {
            shared_.stepper.hand_over_length(lane_, own_);
            return own_.after_accepted(h, error);
        } else {
            return controller_.after_accepted(h, powers());
        }
    }
    [[nodiscard]] Real after_rejected(Real h, Real error) noexcept
    {
        if constexpr (chooses_lengths)
            return own_.after_rejected(h, error);
        else
            return controller_.after_rejected(h, powers());
    }
    [[nodiscard]] Real after_failure(Real h) noexcept requires adaptive
    {
        if constexpr (chooses_lengths) {
            shared_.stepper.hand_over_length(lane_, own_);
            return own_.after_failure(h);
        } else {
            return controller_.after_failure(h);
        }
    }
    template <class Found>
    bool split(Real h, Real last, const Found& found) const requires chooses_lengths
    {
        fetch();
        return own_.split(h, last, found);
    }

    void accept() noexcept { shared_.counts[static_cast<std::size_t>(lane_)] = -1; }
    [[nodiscard]] State derivative() const noexcept
    {
        fetch();
        return own_.derivative();
    }
    auto interpolate(const M& model, Real t, const State& s, Real h, const State& s1, Real theta, State& out) noexcept
    {
        fetch();
        return own_.interpolate(model, t, s, h, s1, theta, out);
    }
    [[nodiscard]] std::size_t calls() const noexcept { return own_.calls() + calls_; }

  private:
    [[nodiscard]] ErrorPowers<Real> powers() const noexcept
    {
        return {shared_.powers.proportional[lane_], shared_.powers.integral[lane_]};
    }

    void fetch() const noexcept
    {
        if (!has_slopes_) shared_.stepper.hand_over(lane_, own_);
        has_slopes_ = true;
    }

    mutable Own own_; ///< begins the trajectory, and computes values inside its steps
    mutable bool has_slopes_ = true;
    Controller<Real> controller_{StepControl{}, 5, Real(0)};
    Shared& shared_;
    int lane_;
    std::size_t calls_ = 0;
};

/// `Method` on a lane.
template <class Method, class Shared, int N>
struct OnLane : Method {
    Shared* shared = nullptr;
    int lane = 0;

    template <class M>
    using Stepper = LaneStepper<M, Method, N>;
};

/// Models and methods that go abreast.
template <class M, class Method>
concept GoesAbreast = TakesPacks<M> && Method::template Stepper<M>::abreast;

/// How many: what a vector register of the target holds.
template <class Real>
inline constexpr int abreast_lanes = static_cast<int>(widest_register / sizeof(Real));

/// How many pieces of `size` trajectories a thread needs: four, and as many as fill its lanes twice.
[[nodiscard]] constexpr std::size_t slots_a_thread(std::size_t size) noexcept
{
    constexpr std::size_t lanes = widest_register / sizeof(float);
    return 4 + 2 * lanes / size;
}

/// A trajectory, with everything that `integrate` takes.
template <class M, class Method, class Observer>
struct Trajectory {
    const M* model;
    const typename M::State* start;
    Interval<typename M::Scalar> span;
    const Method* method;
    const Options<M>* options;
    Observer* observer;
};

/// N trajectories at a time.
template <class M, class Method, int N, class Observer>
class Abreast {
  public:
    using Run = lagen::Run<M>;
    using Given = Trajectory<M, Method, Observer>;

    /// Integrates until no lane has anything to do.
    /// @param next next(lane) answers a pointer to the next trajectory of a lane, or nullptr: there is none now. It is
    ///             asked again at every step. What the trajectory points to lives until it is done.
    /// @param done done(lane, run)
    template <class Next, class Done>
    void run(const Next& next, const Done& done)
    {
        for (;;) {
            bool busy = false;
            for (int lane = 0; lane < N; ++lane) busy = keep_busy(lane, next, done) || busy;
            if (!busy) return;
            shared_->accept();
            if (hurries()) continue;
            shared_->attempt();
            for (int lane = 0; lane < N; ++lane)
                if (marches_[at(lane)]) conclude(lane);
        }
    }

  private:
    using Shared = SharedSteps<M, Method, N>;
    using March = detail::March<M, OnLane<Method, Shared, N>, Observer>;
    static constexpr std::size_t at(int lane) noexcept { return static_cast<std::size_t>(lane); }

    /// Ends what is over and begins what is next, until there is a step to attempt; false where there is none.
    template <class Next, class Done>
    bool keep_busy(int lane, const Next& next, const Done& done)
    {
        std::optional<March>& march = marches_[at(lane)];
        for (;;) {
            if (march) {
                if (proposes(lane)) return true;
                Run run = march->finish(statuses_[at(lane)]);
                march.reset();
                shared_->lengths[at(lane)] = 0;
                shared_->counts[at(lane)] = 0;
                done(lane, std::move(run));
            }
            const Given* given = next(lane);
            if (given == nullptr) return false;
            begin(lane, *given, done);
        }
    }

    template <class Done>
    void begin(int lane, const Given& given, const Done& done)
    {
        if (!shared_) shared_.emplace(*given.method);
        OnLane<Method, Shared, N> method;
        static_cast<Method&>(method) = *given.method;
        method.shared = &*shared_;
        method.lane = lane;
        std::optional<March>& march = marches_[at(lane)];
        march.emplace(*given.model, *given.start, given.span, method, *given.options, *given.observer);
        if (!march->steps_.stepper_.suits()) {
            march.reset();
            detail::March<M, Method, Observer> alone(*given.model, *given.start, given.span, *given.method,
                                                     *given.options, *given.observer);
            done(lane, alone.run());
            return;
        }
        statuses_[at(lane)] = march->begin();
        if (statuses_[at(lane)] == Status::ok) march->steps_.stepper_.enter(march->steps_.model_, march->steps_.s_);
    }

    bool proposes(int lane)
    {
        March& march = *marches_[at(lane)];
        Status& status = statuses_[at(lane)];
        if (!march.goes_on(status)) return false;
        status = march.steps_.propose(attempts_[at(lane)]);
        shared_->times[at(lane)] = march.steps_.t_from_;
        shared_->lengths[at(lane)] = attempts_[at(lane)].h;
        shared_->ends[at(lane)] = march.steps_.end_of(attempts_[at(lane)]);
        return status == Status::ok;
    }

    /// Steps of fixed length at which nothing has to be looked at, in all lanes; false where there are none.
    bool hurries()
    {
        constexpr bool shows = requires(Observer observer, typename M::Scalar t, const typename M::State& s)
        {
            observer(t, s);
        };
        if constexpr (!Shared::Stepper::adaptive && !shows) {
            std::size_t most = std::numeric_limits<std::size_t>::max();
            std::array<typename M::Scalar, static_cast<std::size_t>(N)> lost{};
            for (int lane = 0; lane < N; ++lane) {
                if (!marches_[at(lane)]) continue;
                most = std::min(most, marches_[at(lane)]->unseen_steps());
                lost[at(lane)] = marches_[at(lane)]->steps_.lost_;
            }
            if (most < 2) return false;
            const std::size_t made = shared_->hurry(most, lost);
            for (int lane = 0; lane < N && made > 0; ++lane)
                if (marches_[at(lane)]) {
                    auto& steps = marches_[at(lane)]->steps_;
                    steps.stepper_.made(made, steps.s_);
                    steps.t_ = shared_->times[at(lane)];
                    steps.lost_ = lost[at(lane)];
                    steps.steps_ += made;
                }
            return made > 0;
        }
        return false;
    }

    void conclude(int lane)
    {
        March& march = *marches_[at(lane)];
        const Status status = march.steps_.stepper_.attempted(march.steps_.s_);
        statuses_[at(lane)] = march.conclude(status, attempts_[at(lane)]);
    }

    std::optional<Shared> shared_;
    std::array<std::optional<March>, static_cast<std::size_t>(N)> marches_;
    std::array<typename March::Steps::Attempt, static_cast<std::size_t>(N)> attempts_{};
    std::array<Status, static_cast<std::size_t>(N)> statuses_{};
};

} // namespace lagen::detail
