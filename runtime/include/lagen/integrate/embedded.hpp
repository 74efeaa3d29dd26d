// SPDX-License-Identifier: MIT
/// The stepper of embedded pairs 5(4) whose last stage is the derivative at the end of the step (seven stages, six
/// calls a step). A tableau adds: `error` (b minus the embedded weights), and `dense(theta, weights)`, the
/// interpolant's weights
///   s(t + theta h) = s + h sum_i weights[i] K_i.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/stages.hpp"

namespace lagen {

/// See integrate/integrator.hpp for what is asked of a stepper.
template <class Tableau, class M>
class EmbeddedStepper {
    static_assert(!is_pack<typename M::Scalar>,
                  "adaptive methods choose one step for one trajectory: use a fixed-step method with packs");
    static_assert(std::is_same_v<typename M::State, tangent_t<M>>,
                  "step control measures errors by the lanes of the state: use a fixed-step method with this one");

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = true;
    static constexpr int order = Tableau::order;
    static constexpr int dense_order = 4;
    static constexpr int error_order = 5; ///< the error of the embedded formula is of this order in h
    static constexpr double beta_share = 0.75;

    template <class Method>
    explicit EmbeddedStepper(const Method& method) noexcept : control_(method.control()), scale_(control_)
    {
    }

    Status begin(const M& model, Real t, const State& s) noexcept
    {
        x_ = State::Zero(s.size());
        for (State& stage : k_) stage = x_;
        ++calls_;
        const Status status = model.rhs(t, s, k_[0]);
        return status == Status::ok ? detail::check_finite(k_[0]) : status;
    }

    [[nodiscard]] Real first_step(const M& model, Real t, Real length, const State& s) noexcept
    {
        ++calls_;
        return detail::first_step(model, control_, order, t, length, s, k_[0], x_, k_[1]);
    }

    /// s1 and the scaled error; X of the last stage is s1.
    Status attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        using std::sqrt;
        calls_ += Tableau::stages - 1;
        Status status = detail::evaluate_stages<Tableau, 1, Tableau::stages - 1>(model, t, s, h, x_, k_);
        if (status != Status::ok) return status;
        status = detail::evaluate_stages<Tableau, Tableau::stages - 1, Tableau::stages>(model, t, s, h, s1, k_);
        if (status != Status::ok) return status;
        detail::weighted_sum<Tableau::error>(h, k_, x_);
        error_ = sqrt(detail::squared_error(scale_, s, s1, x_) / static_cast<Real>(s.size()));
        status = detail::check_finite(s1);
        return status == Status::ok ? detail::check_finite(k_.back()) : status;
    }

    [[nodiscard]] Real error() const noexcept { return error_; }

    Status finish(const M&, Real, const State&) noexcept { return Status::ok; }

    void accept() noexcept { k_.front() = k_.back(); }

    [[nodiscard]] const State& derivative() const noexcept { return k_.front(); }

    /// Asks nothing of the model.
    Status interpolate(const M& model, Real, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        std::array<Real, Tableau::stages> weights;
        Tableau::dense(theta, weights);
        State delta = x_;
        for (Eigen::Index lane = 0; lane < s.size(); ++lane) {
            Real sum = Real(0);
            for (std::size_t i = 0; i < Tableau::stages; ++i) sum += weights[i] * k_[i][lane];
            delta[lane] = h * sum;
        }
        out = detail::retracted(model, s, delta);
        return detail::check_finite(out);
    }

    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

  private:
    std::array<State, Tableau::stages> k_;
    State x_;
    StepControl control_;
    detail::ErrorScale<Real> scale_;
    Real error_ = Real(0);
    std::size_t calls_ = 0;
};

} // namespace lagen
