// SPDX-License-Identifier: MIT
/// What a run is asked for besides the method, and what it answers.
#pragma once

#include "lagen/integrate/solution.hpp"
#include "lagen/kernel.hpp"

#include <atomic>
#include <csignal>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace lagen {

/// Which zero crossings of an event function count, in the direction of the run.
enum class Crossing { rising, falling, any };

/// An event to look for: entry `index` of the model's `events`, or `when` where that is given.
/// An event happens where its function changes sign in its direction, between two looks. Fixed-step methods look at the
/// end of every step: an even number of crossings in one is not seen; a smaller step finds them. Adaptive ones, whose
/// steps are long, look four times a step, and between two looks at the turning point of a function that comes nearer
/// to zero and leaves it again. A touch that does not change the sign is none, and a function that stays at zero for a
/// while crosses where it goes on. Crossings of one instant are reported in the order of the requests, all of them,
/// also where one stops the run.
/// At a crossing the motion may jump: it goes on from the state that `jump` answers, as a new run does. A request with
/// a jump happens also at a start, and any request behind another one's jump, where its function is 0, or beyond 0 by
/// at most the absolute tolerance (1e-10 where the method has none), and goes on in its direction: by its rate, or
/// where that is 0 by its first change; so does one that another one's jump takes from one side to the other. None
/// happens behind its own jump until its function has left 0. Requests of one instant are taken in their order, each
/// from the state behind the one before, round by round until a round has none; after 1000 rounds the run ends with
/// `zeno`, in the state before the first. One that stops the run stops it before its jump. Where the jumps of one
/// request follow each other within the rounding of time, or the motion behind one is at once beyond the zero again, or
/// is there by the errors of steps alone, the run ends with `zeno`, too, at the state before the last one.
template <class Real, class State>
struct EventRequest {
    std::size_t index = 0;
    Crossing direction = Crossing::any;
    bool stop = false; ///< the run ends at the count-th crossing
    std::size_t count = 1;
    std::function<Real(Real t, const State& s)> when{};
    std::function<State(Real t, const State& s)> jump{}; ///< the state behind the event, made of that before it
    bool row = false;                                    ///< a row at each crossing, of the state before a jump
};

/// An event found; `request` is its place in the list of requests. `after` is the state behind all jumps of the
/// instant, or the same.
template <class Real, class State>
struct EventFound {
    std::size_t request = 0;
    Real t = Real(0);
    State state;
    State after;
};

inline constexpr std::size_t usual_max_steps = 100'000'000;

template <class M>
struct Run;

/// Everything optional of a run. Rows at `at`: sorted in the direction of the run (invalid_input otherwise), equal ones
/// as often as they stand there; those outside the interval are left out.
template <class M>
struct Options {
    using Real = real_t<typename M::Scalar>;
    using State = typename M::State;

    std::span<const Real> at{};
    std::span<const EventRequest<Real, State>> events{};
    std::size_t max_steps = usual_max_steps; ///< accepted and rejected together; rows do not count
    std::size_t max_jumps = 1'000'000;       ///< more of them end the run with too_many_steps
    const Run<M>* continues = nullptr;       ///< a run that this one goes on from: its events do not happen again
    bool dense = false;                      ///< keep every step for Run::solution
    const std::atomic<bool>* cancel = nullptr;
    const volatile std::sig_atomic_t* signal = nullptr; ///< as cancel, for a signal handler: not zero ends the run
    /// Called every 256 steps with the fraction of the interval that is done.
    std::function<void(double)> progress{};

    /// Somebody outside may end the run, or follows it.
    [[nodiscard]] bool has_company() const noexcept { return cancel != nullptr || signal != nullptr || progress; }
    [[nodiscard]] bool is_cancelled() const noexcept
    {
        return (cancel != nullptr && cancel->load(std::memory_order_relaxed)) || (signal != nullptr && *signal != 0);
    }
};

namespace detail {

/// Options of a run that asks for its end alone, and what its events are watched by: all of it is known when it is
/// compiled.
template <class M>
struct NoOptions {
    using Real = real_t<typename M::Scalar>;
    struct Crossed {
        Real theta;
        std::size_t request;
    };

    static constexpr std::span<const Real> at{};
    static constexpr std::span<const EventRequest<Real, typename M::State>> events{};
    static constexpr std::size_t max_steps = usual_max_steps;
    static constexpr bool dense = false;
    static constexpr void (*progress)(double) = nullptr;
    static constexpr bool has_company() noexcept { return false; }
    static constexpr bool is_cancelled() noexcept { return false; }

    NoOptions() = default;
    template <class Events>
    NoOptions(const M&, const Events&, const Real&) noexcept
    {
    }
    static constexpr bool empty() noexcept { return true; }
    static constexpr bool is_valid() noexcept { return true; }
    static constexpr std::span<const Crossed> crossed() noexcept { return {}; }
};

} // namespace detail

/// What a run found. Converts to true where it ended as asked.
template <class M>
struct [[nodiscard]] Run {
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;

    Real t = Real(0);         ///< of `state`
    State state;              ///< the last good state
    Real failed_at = Real(0); ///< where the run met what ended it; t where nothing failed
    std::size_t steps = 0;    ///< accepted
    std::size_t rejected = 0;
    std::size_t rhs_calls = 0;
    std::size_t newton_iterations = 0; ///< of implicit methods, a call of the right-hand side for every stage each
    std::size_t decompositions = 0;    ///< of implicit methods; all matrices of one Newton iteration count as one
    std::vector<Real> times;           ///< of the rows
    std::vector<State> states;
    std::vector<EventFound<Real, State>> events; ///< in the order of the run
    /// Requests on or beyond whose zero the run starts, and which for that reason do not happen there.
    std::vector<std::size_t> starts_on;
    /// With Options::dense: the state at any time from the start to t, also as (*this)(t).
    Solution<Real, State> solution;
    status_t<Scalar> lanes = StatusOf<Scalar>::good(); ///< a status a lane of a pack; else the status
    Status outcome = Status::ok;

    [[nodiscard]] State operator()(const Real& time) const { return solution(time); }
    [[nodiscard]] Status status() const noexcept { return outcome; }
    [[nodiscard]] explicit operator bool() const noexcept { return is_success(outcome); }
};

} // namespace lagen
