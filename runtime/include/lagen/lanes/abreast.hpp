// SPDX-License-Identifier: MIT
/// Trajectories abreast: each on a lane of a pack, with a time, a step and an end of its own. The right-hand sides and
/// the sums of a step are computed for all lanes at once. Everything else (whether the step counts, the next length,
/// rows, events, the boundary of the domain, statuses) is the march of `integrate`, one a lane, so that a trajectory
/// has the bits that `integrate` gives it, whatever goes on in the other lanes: on processors with fused
/// multiplication where the compiler does not contract (-ffp-contract=off, of g++ 12 -fno-tree-slp-vectorize as well)
/// and terms are summed in one order on all processors (-DLAGEN_SAME_BITS), elsewhere always. A lane whose trajectory
/// has ended takes the next one.
#pragma once

#include "lagen/integrate/march.hpp"
#include "lagen/lanes/lane_stepper.hpp"
#include "lagen/series.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace lagen::detail {

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
concept GoesAbreast = TakesPacks<M> && Method::template Stepper<M>::abreast && !StaysOnGroups<M>;

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
            if (!all(quiet_)) {
                for (int lane = 0; lane < N; ++lane) busy = quiet_[lane] || keep_busy(lane, next, done) || busy;
                if (!busy) return;
            }
            shared_->accept();
            if (hurries()) continue;
            shared_->attempt();
            conclude();
        }
    }

  private:
    using Shared = SharedSteps<M, Method, N>;
    using March = detail::March<M, OnLane<Method, Shared, N>, Observer, Options<M>>;
    using Where = Mask<typename M::Scalar, N>;
    static constexpr bool adaptive = Shared::Stepper::adaptive;
    static constexpr bool shows = requires(Observer observer, typename M::Scalar t, const typename M::State& s)
    {
        observer(t, s);
    };
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
        if (!march->steps_.stepper_.suits() || March::jumps(*given.options)) {
            march.reset();
            detail::March<M, Method, Observer, Options<M>> alone(*given.model, *given.start, given.span, *given.method,
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
        if (status != Status::ok) return false;
        if constexpr (adaptive)
            if (!attempts_[at(lane)].last && march.unseen_steps() > 1) lull(lane, march);
        return true;
    }

    // ---- quiet lanes: nothing has to be looked at, and Shared goes on with them ----

    /// The lane becomes quiet, its integrator having proposed a step that is not the last one.
    void lull(int lane, March& march) noexcept
    {
        auto& steps = march.steps_;
        shared_->quiet.set_lane(lane, steps.way_, steps.h_, steps.lost_,
                                static_cast<typename M::Scalar>(steps.method_.control().max_step));
        steps.stepper_.lend();
        quiet_.lanes[lane] = -1;
        since_[at(lane)] = attempts_made_;
        due_[at(lane)] = attempts_made_ + march.unseen_steps() - 1;
        first_due_ = std::min(first_due_, due_[at(lane)]);
    }

    /// Its integrator stands where the lane has come to, before the attempt that was just made.
    void wake(int lane) noexcept
    {
        quiet_.lanes[lane] = 0;
        auto& steps = marches_[at(lane)]->steps_;
        const std::size_t made = attempts_made_ - since_[at(lane)];
        if (made == 0) return;
        steps.stepper_.made(made, steps.from_);
        steps.stepper_.take_back();
        steps.t_ = steps.t_from_ = shared_->times[at(lane)];
        steps.h_ = shared_->quiet.asked[lane];
        steps.lost_ = steps.lost_from_ = shared_->quiet.lost[lane];
        steps.steps_ += made;
        steps.failed_length_ = 0;
        steps.imprecise_ = steps.retry_ = false;
        attempts_[at(lane)] = {shared_->lengths[at(lane)], false};
    }

    /// Lanes whose steps run out are not quiet.
    void stir() noexcept
    {
        first_due_ = std::numeric_limits<std::size_t>::max();
        for (int lane = 0; lane < N; ++lane) {
            if (!quiet_[lane]) continue;
            if (due_[at(lane)] <= attempts_made_)
                wake(lane);
            else
                first_due_ = std::min(first_due_, due_[at(lane)]);
        }
    }

    void conclude()
    {
        Where stays{};
        if constexpr (adaptive) {
            if (first_due_ <= attempts_made_) stir();
            if (any(quiet_)) stays = shared_->go_on(quiet_);
        }
        if (shows || !all(stays))
            for (int lane = 0; lane < N; ++lane) {
                if (!marches_[at(lane)]) continue;
                if (stays[lane]) {
                    show(lane);
                    continue;
                }
                if (quiet_[lane]) wake(lane);
                conclude(lane);
            }
        ++attempts_made_;
    }

    /// To the observer of a quiet lane.
    void show([[maybe_unused]] int lane)
    {
        if constexpr (shows) {
            auto& steps = marches_[at(lane)]->steps_;
            for (Eigen::Index i = 0; i < steps.s_.size(); ++i) steps.s_[i] = shared_->to[i][lane];
            marches_[at(lane)]->observer_(shared_->times[at(lane)], steps.s_);
        }
    }

    /// Steps of fixed length at which nothing has to be looked at, in all lanes; false where there are none.
    bool hurries()
    {
        if constexpr (!adaptive && !shows) {
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
    Where quiet_{};
    std::array<std::size_t, static_cast<std::size_t>(N)> since_{}, due_{}; ///< by attempts_made_
    std::size_t attempts_made_ = 0, first_due_ = std::numeric_limits<std::size_t>::max();
};

} // namespace lagen::detail
