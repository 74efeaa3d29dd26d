// SPDX-License-Identifier: MIT
/// The stepper of one trajectory on a lane: lanes/abreast.hpp. The steps are those of all lanes.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/states.hpp"
#include "lagen/integrate/way.hpp"
#include "lagen/lanes/pack.hpp"
#include "lagen/lanes/packed_stages.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

namespace lagen::detail {

// Times and lengths of trajectories abreast at whose steps nothing has to be looked at: what Integrator does of a step
// that counts and of the next one, which is not the last, for all lanes at once and with the same bits.

template <class Real, int N>
struct QuietWays {
    using P = Pack<Real, N>;
    using Where = Mask<Real, N>;
    using Lanes = std::array<Real, static_cast<std::size_t>(N)>;

    /// A lane becomes quiet. `cap`: the longest step, if it is positive.
    void set_lane(int lane, const Way<Real>& way, const Real& h, const Real& rounding, const Real& cap) noexcept
    {
        asked.set(lane, h);
        lost.set(lane, rounding);
        end.set(lane, way.end);
        length.set(lane, way.length);
        direction.set(lane, way.directed(Real(1)));
        most.set(lane, cap > Real(0) ? cap : std::numeric_limits<Real>::infinity());
    }

    /// A step that a cap cut short says nothing against the length that was asked for.
    [[nodiscard]] P uncut(const P& size, const P& next) const noexcept
    {
        return select(size < asked && next < asked, asked, next);
    }

    /// Where a step counted, the next one begins at its end and is as long as `next` says, unless it would be the last
    /// or lost in the rounding of time: see Way and Integrator. Answers where it is not; elsewhere nothing changes.
    Where go_on(Where counts, const P& next, Lanes& times, Lanes& lengths, Lanes& ends) noexcept
    {
        const P t(times), h(lengths), t1(ends);
        const P epsilon(std::numeric_limits<Real>::epsilon());
        const P reaches = min(P(Real(1.01)) * next, most);
        counts = counts && reaches < abs(end - t1) && P(Real(0.1)) * next > epsilon * max(abs(t1), epsilon * length);
        const P rounding = (t1 - t) - (h - lost), step = direction * min(next, most);
        asked = select(counts, next, asked);
        lost = select(counts, rounding, lost);
        put(times, select(counts, t1, t));
        put(lengths, select(counts, step, h));
        put(ends, select(counts, t1 + (step - lost), t1));
        return counts;
    }

    P asked{}, lost{}; ///< the length that the controller asks for; the rounding error of the time

  private:
    static void put(Lanes& lanes, const P& pack) noexcept { std::memcpy(lanes.data(), &pack, sizeof pack); }

    P end{}, length{}, direction{}, most{};
};

// What trajectories abreast share: a model and a stepper over packs whose lanes have times of their own.

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
    static constexpr bool foresees = requires { Stepper::foresees; };

    explicit SharedSteps(const Method& method) noexcept : stepper(method) {}

    /// A trajectory of `own`, the stepper of it alone, begins on a lane; the first one on all, so that none computes
    /// with nothing.
    template <class Own>
    void adopt(int lane, const M& own_model, const typename M::State& s, const Own& own,
               const Controller<Real>& own_controller) noexcept
    {
        const int first = empty ? 0 : lane, last = empty ? N - 1 : lane;
        give_numbers(own_model, model, [&](P& to_lanes, const Real& number) {
            for (int i = first; i <= last; ++i) to_lanes.set(i, number);
        });
        if (empty) to = from = State::Zero(s.size());
        for (int i = first; i <= last; ++i) {
            stepper.adopt(i, own);
            controller.set_lane(i, own_controller);
            for (Eigen::Index k = 0; k < s.size(); ++k) from[k].set(i, s[k]);
        }
        counts[static_cast<std::size_t>(lane)] = 0;
        empty = false;
    }

    /// What the lanes have accepted counts.
    void accept() noexcept
    {
        Mask<Real, N> where{};
        static_assert(sizeof where == sizeof counts);
        std::memcpy(&where, counts.data(), sizeof where);
        stepper.accept(where);
        for (Eigen::Index i = 0; i < from.size(); ++i) from[i] = select(where, to[i], from[i]);
        counts.fill(0);
    }

    /// The next step of all of them. Of small models with everything in one function, so that what the stages have in
    /// common, as the reciprocals of parameters, is computed once.
    void attempt() noexcept
    {
        if constexpr (M::dimension > 0 && M::dimension <= 8)
            attempt_in_one();
        else
            attempt_by_calls();
    }
    [[gnu::flatten]] void attempt_in_one() noexcept { attempt_by_calls(); }
    void attempt_by_calls() noexcept
    {
        const P begin(times), length(lengths);
        const std::size_t before = stepper.calls();
        status = stepper.attempt(model, begin, from, length, to);
        calls = stepper.calls() - before;
        if constexpr (Stepper::adaptive) {
            error = stepper.error();
            if constexpr (!foresees) powers = controller.powers(error);
            finished = stepper.finish(model, P(ends), to);
        }
        calls_at_end = stepper.calls() - before - calls;
    }

    /// Takes the attempt in the lanes that are quiet, where it counts and is followed by another one at which nothing
    /// has to be looked at. Answers where that is so.
    Mask<Real, N> go_on(const Mask<Real, N>& quiet_lanes) noexcept
    {
        const P h(lengths), t1(ends);
        const auto good = StatusOf<P>::first(StatusOf<P>::first(status, finished), domain_status(model, t1, to));
        P next;
        if constexpr (foresees)
            next = stepper.after_accepted(abs(h), error);
        else
            next = quiet.uncut(abs(h), controller.length_after(abs(h), powers));
        const Mask<Real, N> stays =
            quiet.go_on(quiet_lanes && is_good<P>(good) && error <= P(1), next, times, lengths, ends);
        if constexpr (!foresees) controller.accept(stays, powers);
        std::memcpy(counts.data(), &stays, sizeof stays);
        return stays;
    }

    /// Up to `most` steps of fixed length in all lanes, as long as none fails; `lost` are the rounding errors of their
    /// times. Answers how many were made.
    std::size_t hurry(std::size_t most, std::array<Real, lanes>& lost) noexcept
    {
        P t(times), rest(lost);
        const P length(lengths);
        const Mask<Real, N> everywhere{~typename Mask<Real, N>::Vector{}};
        const std::size_t before = stepper.calls();
        std::size_t made = 0;
        for (; made < most; ++made) {
            const P increment = length - rest, t1 = t + increment;
            status = stepper.attempt(model, t, from, length, to);
            status = StatusOf<P>::first(status, domain_status(model, t1, to));
            if (!StatusOf<P>::all_good(status)) break;
            rest = (t1 - t) - increment;
            t = t1;
            stepper.accept(everywhere);
            from = to;
        }
        calls = made == 0 ? 0 : (stepper.calls() - before) / (made < most ? made + 1 : made);
        std::memcpy(times.data(), &t, sizeof t);
        std::memcpy(lost.data(), &rest, sizeof rest);
        return made;
    }

    Model model{};
    Stepper stepper;
    State from, to;
    std::array<Real, lanes> times{}, lengths{}, ends{};
    std::array<typename IntegerOf<sizeof(Real)>::type, lanes> counts{}; ///< -1: the lane's last step was accepted
    PackStatus<N> status, finished;
    P error;
    Controller<P> controller{StepControl{}, 5, P(0)};
    ErrorPowers<P> powers{};
    QuietWays<Real, N> quiet;
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
    void enter(const M& model, const State& s) noexcept { shared_.adopt(lane_, model, s, own_, controller_); }
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
    /// The controller goes on in the lane, and comes back.
    void lend() noexcept { shared_.controller.set_lane(lane_, controller_); }
    void take_back() noexcept { shared_.controller.get_lane(lane_, controller_); }
    /// So many steps were made, and count.
    void made(std::size_t steps, State& s) noexcept
    {
        calls_ += steps * (shared_.calls + shared_.calls_at_end);
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

} // namespace lagen::detail
