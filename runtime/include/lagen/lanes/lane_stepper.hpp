// SPDX-License-Identifier: MIT
/// The stepper of one trajectory on a lane: lanes/abreast.hpp. The steps are those of all lanes.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/lanes/shared_steps.hpp"

#include <cstddef>

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
