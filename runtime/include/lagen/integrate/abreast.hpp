// SPDX-License-Identifier: MIT
/// Trajectories abreast: each on a lane of a pack, with a time, a step and an end of its own. The right-hand sides and
/// the sums of a step are computed for all lanes at once. Everything else (whether the step counts, the next length,
/// rows, events, the boundary of the domain, statuses) is the march of `integrate`, one a lane, so that a trajectory
/// has the bits that `integrate` gives it, whatever goes on in the other lanes: on processors with fused
/// multiplication where the compiler does not contract (-ffp-contract=off), elsewhere always. A lane whose trajectory
/// has ended takes the next one.
#pragma once

#include "lagen/ensemble/pack.hpp"
#include "lagen/integrate/march.hpp"
#include "lagen/integrate/packed_stages.hpp"
#include "lagen/series.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>

namespace lagen::detail {

/// A model over packs whose lanes have times of their own.
template <class Model>
struct OwnTimes : Model {
    using Time = typename Model::Scalar;
};

/// What the lanes of a pack share: the model, the stepper, and the step that is attempted.
template <class M, class Method, int N>
struct SharedSteps {
    using Real = typename M::Scalar;
    using P = Pack<Real, N>;
    using Model = OwnTimes<typename WithScalar<M, P>::type>;
    using Stepper = typename Method::template Stepper<Model>;
    using State = typename Model::State;
    static constexpr auto lanes = static_cast<std::size_t>(N);

    explicit SharedSteps(const Method& method) noexcept : stepper(method) {}

    /// A trajectory of `own`, the stepper of it alone, begins on a lane; the first one on all, so that none computes
    /// with nothing.
    template <class Own>
    void adopt(int lane, const M& own_model, const typename M::State& s, const Own& own) noexcept
    {
        if constexpr (!std::is_empty_v<M>) {
            M copy = own_model;
            for (std::size_t k = 0; k < M::parameter_names.size(); ++k)
                for (int i = empty ? 0 : lane; i <= (empty ? N - 1 : lane); ++i)
                    model.parameter(k).set(i, copy.parameter(k));
        }
        if (empty) to = from = State::Zero(s.size());
        for (int i = empty ? 0 : lane; i <= (empty ? N - 1 : lane); ++i) {
            stepper.adopt(i, own);
            for (Eigen::Index k = 0; k < s.size(); ++k) from[k].set(i, s[k]);
        }
        counts[static_cast<std::size_t>(lane)] = 0;
        empty = false;
    }

    /// What the lanes have accepted counts; then the next step of all of them.
    void attempt() noexcept
    {
        Mask<Real, N> where{};
        static_assert(sizeof where == sizeof counts);
        std::memcpy(&where, counts.data(), sizeof where);
        stepper.accept(where);
        for (Eigen::Index i = 0; i < from.size(); ++i) from[i] = select(where, to[i], from[i]);
        counts.fill(0);
        const P begin(times), length(lengths);
        const std::size_t before = stepper.calls();
        status = stepper.attempt(model, begin, from, length, to);
        calls = stepper.calls() - before;
        if constexpr (Stepper::adaptive) {
            error = stepper.error();
            finished = stepper.finish(model, P(ends), to);
        }
        calls_at_end = stepper.calls() - before - calls;
    }

    Model model{};
    Stepper stepper;
    State from, to;
    std::array<Real, lanes> times{}, lengths{}, ends{};
    std::array<typename IntegerOf<sizeof(Real)>::type, lanes> counts{}; ///< -1: the lane's last step was accepted
    PackStatus<N> status, finished;
    P error;
    std::size_t calls = 0, calls_at_end = 0; ///< of one attempt, and of finish
    bool empty = true;
};

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

/// The stepper of one trajectory on a lane: see integrate/integrator.hpp for what is asked of a stepper.
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
    }

    Status begin(const M& model, Real t, const State& s) noexcept { return own_.begin(model, t, s); }
    /// The trajectory takes its lane.
    void enter(const M& model, const State& s) noexcept { shared_.adopt(lane_, model, s, own_); }
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
    [[nodiscard]] Real error() const noexcept { return shared_.error[lane_]; }
    Status finish(const M&, Real, const State&) noexcept
    {
        calls_ += shared_.calls_at_end;
        return shared_.finished[lane_];
    }
    // Of methods that choose their lengths themselves:
    [[nodiscard]] Real after_accepted(Real h, Real error) noexcept requires chooses_lengths
    {
        shared_.stepper.hand_over_length(lane_, own_);
        return own_.after_accepted(h, error);
    }
    [[nodiscard]] Real after_rejected(Real h, Real error) noexcept requires chooses_lengths
    {
        return own_.after_rejected(h, error);
    }
    [[nodiscard]] Real after_failure(Real h) noexcept requires chooses_lengths { return own_.after_failure(h); }
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
    void fetch() const noexcept
    {
        if (!has_slopes_) shared_.stepper.hand_over(lane_, own_);
        has_slopes_ = true;
    }

    mutable Own own_; ///< begins the trajectory, and computes values inside its steps
    mutable bool has_slopes_ = true;
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
    /// @param next next(lane) answers a pointer to the next trajectory of a lane, which lives until it is done, or
    ///             nullptr: there is none now. It is asked again at every step.
    /// @param done done(lane, run)
    template <class Next, class Done>
    void run(const Next& next, const Done& done)
    {
        for (;;) {
            bool busy = false;
            for (int lane = 0; lane < N; ++lane) busy = keep_busy(lane, next, done) || busy;
            if (!busy) return;
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
        if (statuses_[at(lane)] == Status::ok)
            march->steps_.stepper_.enter(march->steps_.model_, march->steps_.s_);
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
