// SPDX-License-Identifier: MIT
/// Explicit Runge-Kutta methods with a fixed step: `lagen::Rk4{.step = 0.01}`. Work with every scalar, packs included.
/// Between steps they have no interpolant; a value inside a step is a shorter step of the same method from the
/// beginning of that step, so that it has the full order and leaves the sequence of steps alone.
#pragma once

#include "lagen/integrate/stages.hpp"
#include "lagen/run.hpp"

namespace lagen {

namespace tableau {

/// Explicit Euler.
struct Euler {
    static constexpr std::size_t stages = 1;
    static constexpr int order = 1;
    static constexpr std::array<Fraction, 0> a{};
    static constexpr std::array<Fraction, 1> b{{{1, 1}}};
    static constexpr std::array<Fraction, 1> c{{{0, 1}}};
};

/// Explicit midpoint rule [Runge 1895].
struct Midpoint {
    static constexpr std::size_t stages = 2;
    static constexpr int order = 2;
    static constexpr std::array<Fraction, 1> a{{{1, 2}}};
    static constexpr std::array<Fraction, 2> b{{{0, 1}, {1, 1}}};
    static constexpr std::array<Fraction, 2> c{{{0, 1}, {1, 2}}};
};

/// Explicit trapezoidal rule [Heun 1900].
struct Heun {
    static constexpr std::size_t stages = 2;
    static constexpr int order = 2;
    static constexpr std::array<Fraction, 1> a{{{1, 1}}};
    static constexpr std::array<Fraction, 2> b{{{1, 2}, {1, 2}}};
    static constexpr std::array<Fraction, 2> c{{{0, 1}, {1, 1}}};
};

/// Second order with the least truncation error [Ralston 1962].
struct Ralston {
    static constexpr std::size_t stages = 2;
    static constexpr int order = 2;
    static constexpr std::array<Fraction, 1> a{{{2, 3}}};
    static constexpr std::array<Fraction, 2> b{{{1, 4}, {3, 4}}};
    static constexpr std::array<Fraction, 2> c{{{0, 1}, {2, 3}}};
};

/// Third order, Simpson's nodes [Kutta 1901].
struct Kutta3 {
    static constexpr std::size_t stages = 3;
    static constexpr int order = 3;
    static constexpr std::array<Fraction, 3> a{{{1, 2}, {-1, 1}, {2, 1}}};
    static constexpr std::array<Fraction, 3> b{{{1, 6}, {2, 3}, {1, 6}}};
    static constexpr std::array<Fraction, 3> c{{{0, 1}, {1, 2}, {1, 1}}};
};

/// The classical method of order 4 [Kutta 1901].
struct Rk4 {
    static constexpr std::size_t stages = 4;
    static constexpr int order = 4;
    static constexpr std::array<Fraction, 6> a{{{1, 2}, {0, 1}, {1, 2}, {0, 1}, {0, 1}, {1, 1}}};
    static constexpr std::array<Fraction, 4> b{{{1, 6}, {1, 3}, {1, 3}, {1, 6}}};
    static constexpr std::array<Fraction, 4> c{{{0, 1}, {1, 2}, {1, 2}, {1, 1}}};
};

/// The 3/8 rule [Kutta 1901].
struct Rk38 {
    static constexpr std::size_t stages = 4;
    static constexpr int order = 4;
    static constexpr std::array<Fraction, 6> a{{{1, 3}, {-1, 3}, {1, 1}, {1, 1}, {-1, 1}, {1, 1}}};
    static constexpr std::array<Fraction, 4> b{{{1, 8}, {3, 8}, {3, 8}, {1, 8}}};
    static constexpr std::array<Fraction, 4> c{{{0, 1}, {1, 3}, {2, 3}, {1, 1}}};
};

} // namespace tableau

/// The stepper of an explicit fixed-step method on model M: see integrate/stepper.hpp for what is asked of it.
template <class Tableau, class M>
class FixedStepper {
  public:
    using Scalar = typename M::Scalar;
    using Real = step_time_t<M>;
    using State = typename M::State;
    using Tangent = tangent_t<M>;
    static constexpr bool adaptive = false;
    static constexpr bool abreast = true;
    static constexpr int order = Tableau::order;
    static constexpr int dense_order = Tableau::order;

    template <class Method>
    explicit FixedStepper(const Method& method) noexcept : compensated_(method.compensated)
    {
    }

    /// Sets the compensation to zero, which only sums have; no derivative is kept from step to step.
    status_t<Scalar> begin(const M&, Real, const State& s) noexcept
    {
        auto status = StatusOf<Scalar>::good();
        if constexpr (moves_by_sums<M>) {
            lost_ = Tangent::Zero(s.size());
            next_lost_ = lost_;
            if constexpr (!is_local) {
                for (Tangent& slope : scratch_.k) slope = lost_;
                scratch_.x = lost_;
            }
        } else {
            StatusOf<Scalar>::fail(status, compensated_, Status::invalid_input);
        }
        return status;
    }

    /// s1 = s + h sum_i b_i K_i; where `compensated`, with the low-order part of earlier sums [Kahan 1965].
    [[gnu::always_inline]] status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        return move(model, t, s, h, s1, compensated_);
    }

    void accept() noexcept
    {
        if (compensated_) lost_ = next_lost_;
    }

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    status_t<Scalar> interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta,
                                 State& out) noexcept
    {
        return move(model, t, s, theta * h, out, false);
    }

    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

    // ---- of packs whose lanes are trajectories: lanes/abreast.hpp ----

    /// Can a trajectory of `own` go on a lane beside the others?
    template <class Own>
    [[nodiscard]] bool suits(const Own& own) const noexcept requires(is_pack<Scalar>)
    {
        return own.compensated_ == compensated_;
    }
    template <class Own>
    void adopt(int lane, const Own& own) noexcept requires(is_pack<Scalar>)
    {
        const Eigen::Index size = own.lost_.size();
        if (lost_.size() != size) {
            next_lost_ = lost_ = Tangent::Zero(size);
            if constexpr (!is_local) {
                for (Tangent& slope : scratch_.k) slope = lost_;
                scratch_.x = lost_;
            }
        }
        for (Eigen::Index i = 0; i < size; ++i) lost_[i].set(lane, own.lost_[i]);
    }
    template <class Own>
    void hand_over(int, Own&) const noexcept requires(is_pack<Scalar>)
    {
    }
    void accept(const typename StatusOf<Scalar>::mask& where) noexcept requires(is_pack<Scalar>)
    {
        if (compensated_)
            for (Eigen::Index i = 0; i < lost_.size(); ++i) lost_[i] = select(where, next_lost_[i], lost_[i]);
    }

  private:
    template <class, class>
    friend class FixedStepper;
    using Scratch = detail::StageScratch<M, Tableau::stages>;
    struct Nothing {};
    /// What a step alone needs is local to it where it is short and of a built-in scalar, so that it may live in
    /// registers; otherwise it is kept, and nothing is allocated but at the start.
    static constexpr bool is_local = detail::is_short<Tangent>;

    using Local = std::conditional_t<is_local, Scratch, Nothing>;
    using Kept = std::conditional_t<is_local, Nothing, Scratch>;
    Scratch& choose(Scratch& local, Nothing&) noexcept { return local; }
    Scratch& choose(Nothing&, Scratch& kept) noexcept { return kept; }

    [[gnu::always_inline]] status_t<Scalar> move(const M& model, Real t, const State& s, Real h, State& out,
                                                 bool compensated) noexcept
    {
        Local local;
        Scratch& scratch = choose(local, scratch_);
        const auto status = stages(model, t, s, h, scratch);
        if (!is_pack<Scalar> && !StatusOf<Scalar>::all_good(status)) return status;
        if constexpr (moves_by_sums<M>) {
            if (compensated) {
                add_compensated(s, h, scratch, out);
                return StatusOf<Scalar>::first(status, detail::check_finite(out));
            }
        }
        return StatusOf<Scalar>::first(
            status, detail::move_checked<Tableau::b, 0, Tableau::stages>(model, s, h, scratch.k, out));
    }

    void add_compensated(const State& s, Real h, const Scratch& scratch, State& s1) noexcept
    {
        detail::for_lanes(s, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            using Slice = detail::Slice<State, width>;
            const auto all = std::make_index_sequence<Tableau::stages>{};
            const Slice sum = detail::weighted_lanes<Tableau::b, 0, width>(h, scratch.k, lane, all);
            const Slice increment = sum - detail::load<width>(lost_, lane);
            const Slice here = detail::load<width>(s, lane), there = here + increment;
            detail::store(s1, lane, there);
            detail::store(next_lost_, lane, (there - here) - increment);
        });
    }

    [[gnu::always_inline]] status_t<Scalar> stages(const M& model, Real t, const State& s, Real h,
                                                   Scratch& scratch) noexcept
    {
        calls_ += Tableau::stages;
        const auto status = model.rhs(Scalar(t), s, scratch.k[0]);
        if (!is_pack<Scalar> && !StatusOf<Scalar>::all_good(status)) return status;
        return StatusOf<Scalar>::first(
            status, detail::evaluate_stages<Tableau, 1, Tableau::stages>(model, t, s, h, scratch.x, scratch.k));
    }

    Kept scratch_;
    Tangent lost_, next_lost_;
    std::size_t calls_ = 0;
    bool compensated_;
};

/// A fixed-step method. `step` is positive; `compensated` carries the rounding errors of the sums along.
template <class Tableau>
struct FixedMethod {
    double step = 0;
    bool compensated = false;

    template <class M>
    using Stepper = FixedStepper<Tableau, M>;
};

using Euler = FixedMethod<tableau::Euler>;
using Midpoint = FixedMethod<tableau::Midpoint>;
using Heun = FixedMethod<tableau::Heun>;
using Ralston = FixedMethod<tableau::Ralston>;
using Kutta3 = FixedMethod<tableau::Kutta3>;
using Rk4 = FixedMethod<tableau::Rk4>;
using Rk38 = FixedMethod<tableau::Rk38>;

} // namespace lagen
