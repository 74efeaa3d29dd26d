// SPDX-License-Identifier: MIT
/// What trajectories abreast share: a model and a stepper over packs whose lanes have times of their own.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/states.hpp"
#include "lagen/lanes/pack.hpp"
#include "lagen/lanes/packed_stages.hpp"
#include "lagen/lanes/quiet_ways.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

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

} // namespace lagen::detail
