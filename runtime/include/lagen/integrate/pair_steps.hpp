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
    static_assert(!is_pack<typename M::Scalar> || detail::NamesTime<M>,
                  "adaptive methods choose one step for one trajectory: use a fixed-step method with packs, or "
                  "lagen::ensemble");

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = true;
    static constexpr int order = order_of_step;

    status_t<Scalar> begin(const M& model, Real t, const State& s) noexcept
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
    status_t<Scalar> finish(const M& model, Real t1, const State& s1) noexcept
    {
        return slope_at(model, t1, s1, k_[end]);
    }

    void accept() noexcept { k_.front() = k_[end]; }

    [[nodiscard]] const State& derivative() const noexcept { return k_.front(); }

    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

    // ---- of packs whose lanes are trajectories: lanes/abreast.hpp ----

    /// Can a trajectory of `own` go on a lane beside the others?
    template <class Own>
    [[nodiscard]] bool suits(const Own&) const noexcept requires(is_pack<Scalar>)
    {
        return true;
    }

    /// Lane `lane` begins as `own`, the stepper of its trajectory, has begun.
    template <class One>
    void adopt(int lane, const PairSteps<One, order, slopes, end>& own) noexcept requires(is_pack<Scalar>)
    {
        scale_.set_lane(lane, own.scale_);
        if (x_.size() != own.x_.size()) {
            x_ = State::Zero(own.x_.size());
            for (State& slope : k_) slope = x_;
        }
        for (Eigen::Index i = 0; i < x_.size(); ++i) k_.front()[i].set(lane, own.k_.front()[i]);
    }

    /// What values inside the last step of lane `lane` are made of.
    template <class One>
    void hand_over(int lane, PairSteps<One, order, slopes, end>& own) const noexcept requires(is_pack<Scalar>)
    {
        for (std::size_t j = 0; j < slopes; ++j)
            for (Eigen::Index i = 0; i < x_.size(); ++i) own.k_[j][i] = k_[j][i][lane];
        own.dense_ready_ = false;
    }

    /// The step counts in these lanes.
    void accept(const typename StatusOf<Scalar>::mask& where) noexcept requires(is_pack<Scalar>)
    {
        for (Eigen::Index i = 0; i < x_.size(); ++i) k_.front()[i] = select(where, k_[end][i], k_.front()[i]);
    }

  protected:
    explicit PairSteps(const StepControl& control) noexcept : control_(control), scale_(control) {}

    /// Ends this the attempt? Where lanes of a pack fail, the others go on.
    static bool fails(const status_t<Scalar>& status) noexcept
    {
        return !is_pack<Scalar> && !StatusOf<Scalar>::all_good(status);
    }

    std::array<State, slopes> k_;
    State x_; ///< a stage
    StepControl control_;
    detail::ErrorScale<Real> scale_;
    Real error_ = Real(0);
    std::size_t calls_ = 0;
    bool dense_ready_ = false; ///< what values inside the step need is there

  private:
    template <class, int, std::size_t, std::size_t>
    friend class PairSteps;

    status_t<Scalar> slope_at(const M& model, Real t, const State& s, State& slope) noexcept
    {
        ++calls_;
        const auto status = model.rhs(t, s, slope);
        if (fails(status)) return status;
        return StatusOf<Scalar>::first(status, detail::check_finite(slope));
    }
};

} // namespace lagen
