// SPDX-License-Identifier: MIT
/// What the steppers of explicit pairs with an error estimate have in common: the slopes K_0 .. of a step, the first of
/// them at its beginning and the one called `end` at its end, the scale of errors, and the count of calls.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/states.hpp"

#include <array>
#include <cstddef>

namespace lagen {

template <class M, int order_of_step, std::size_t slopes, std::size_t end>
class PairSteps {
    static_assert(!is_pack<typename M::Scalar>,
                  "adaptive methods choose one step for one trajectory: use a fixed-step method with packs");

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = true;
    static constexpr int order = order_of_step;

    Status begin(const M& model, Real t, const State& s) noexcept
    {
        x_ = State::Zero(s.size());
        for (State& slope : k_) slope = x_;
        return slope_at(model, t, s, k_.front());
    }

    [[nodiscard]] Real first_step(const M& model, Real t, Real length, const State& s) noexcept
    {
        ++calls_;
        return detail::first_step(model, control_, order, t, length, s, k_[0], x_, k_[1]);
    }

    [[nodiscard]] Real error() const noexcept { return error_; }

    /// The derivative at the end of a step that will be accepted.
    Status finish(const M& model, Real t1, const State& s1) noexcept { return slope_at(model, t1, s1, k_[end]); }

    void accept() noexcept { k_.front() = k_[end]; }

    [[nodiscard]] const State& derivative() const noexcept { return k_.front(); }

    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

  protected:
    explicit PairSteps(const StepControl& control) noexcept : control_(control), scale_(control) {}

    std::array<State, slopes> k_;
    State x_; ///< a stage
    StepControl control_;
    detail::ErrorScale<Real> scale_;
    Real error_ = Real(0);
    std::size_t calls_ = 0;
    bool dense_ready_ = false; ///< what values inside the step need is there

  private:
    Status slope_at(const M& model, Real t, const State& s, State& slope) noexcept
    {
        ++calls_;
        const Status status = model.rhs(t, s, slope);
        return status == Status::ok ? detail::check_finite(slope) : status;
    }
};

} // namespace lagen
