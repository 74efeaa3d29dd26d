// SPDX-License-Identifier: MIT
/// The stepper of embedded pairs: the arrays of tableau.hpp, or `dense(theta, weights)` in the place of `interpolant`.
///   s(t + theta h) = s + h sum_i weights[i] K_i.
#pragma once

#include "lagen/integrate/pair_steps.hpp"
#include "lagen/integrate/stages.hpp"

namespace lagen {

/// See integrate/stepper.hpp for what is asked of a stepper.
template <class Tableau, class M>
class EmbeddedStepper : public PairSteps<M, Tableau::order, Tableau::dense_stages, Tableau::end> {
    using Base = PairSteps<M, Tableau::order, Tableau::dense_stages, Tableau::end>;
    using Base::calls_, Base::dense_ready_, Base::error_, Base::fails, Base::k_, Base::scale_, Base::x_;
    static_assert(std::is_same_v<typename M::State, tangent_t<M>>,
                  "step control measures errors by the lanes of the state: use a fixed-step method with this one");

  public:
    using Scalar = typename Base::Scalar;
    using Real = typename Base::Real;
    using State = typename Base::State;
    static constexpr bool abreast = true;
    static constexpr int dense_order = Tableau::dense_order;
    static constexpr int error_order = Tableau::embedded_order + 1; ///< the error of that formula is of it in h
    static constexpr double beta_share = 0.75;

    template <class Method>
    explicit EmbeddedStepper(const Method& method) noexcept : Base(method.control())
    {
    }

    /// s1, which is X of the stage at the end, and the scaled error.
    status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        dense_ready_ = false;
        calls_ += ends_in_stage ? end : end - 1;
        auto status = detail::evaluate_stages<Tableau, 1, end>(model, t, s, h, x_, k_);
        if (fails(status)) return status;
        if constexpr (ends_in_stage) {
            status = Lanes::first(status, detail::evaluate_stages<Tableau, end, end + 1>(model, t, s, h, s1, k_));
            if (fails(status)) return status;
        } else {
            detail::move_along<Tableau::a, detail::lower_index(end, 0), end>(model, s, h, k_, s1);
        }
        estimate(s, h, s1);
        status = Lanes::first(status, detail::check_finite(s1));
        if (!ends_in_stage || fails(status)) return status;
        return Lanes::first(status, detail::check_finite(k_[end]));
    }

    status_t<Scalar> finish(const M& model, Real t1, const State& s1) noexcept
    {
        if constexpr (ends_in_stage) return Lanes::good();
        return Base::finish(model, t1, s1);
    }

    /// Evaluates the stages behind the end once a step.
    Status interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        if (!dense_ready_) {
            calls_ += all - 1 - end;
            const Status status = detail::evaluate_stages<Tableau, end + 1, all>(model, t, s, h, x_, k_);
            if (status != Status::ok) return status;
            dense_ready_ = true;
        }
        State delta = x_;
        add_stages(h, theta, delta, std::make_index_sequence<all>{});
        out = detail::retracted(model, s, delta);
        return detail::check_finite(out);
    }

  private:
    using Lanes = StatusOf<Scalar>;
    static constexpr std::size_t end = Tableau::end, all = Tableau::dense_stages;
    static constexpr bool ends_in_stage = end < Tableau::stages;

    /// The norm of h sum_i error_i K_i.
    void estimate(const State& s, Real h, const State& s1) noexcept
    {
        using std::sqrt;
        Real sum = Real(0);
        detail::for_lanes(s, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            using Slice = detail::Slice<State, width>;
            const auto stages = std::make_index_sequence<Tableau::stages>{};
            const Slice e = detail::weighted_lanes<Tableau::error, 0, width>(h, k_, lane, stages);
            const Slice ratio = e / scale_.template of<width>(s, s1, lane);
            sum = detail::sum_with(sum, Slice(ratio * ratio));
        });
        error_ = sqrt(sum / Real(static_cast<real_t<Real>>(s.size())));
    }

    /// delta = h sum_i b_i(theta) K_i, over the stages that the interpolant uses.
    template <std::size_t... i>
    void add_stages(const Real& h, const Real& theta, State& delta, std::index_sequence<i...>) const noexcept
    {
        std::array<Real, all> weights{};
        if constexpr (requires { Tableau::interpolant; })
            ((weights[i] = detail::interpolant_weight<Tableau, i>(theta)), ...);
        else
            Tableau::dense(theta, weights);
        for (Eigen::Index lane = 0; lane < delta.size(); ++lane) {
            Real sum = Real(0);
            ((sum += uses<i>() ? Real(weights[i] * k_[i][lane]) : Real(0)), ...);
            delta[lane] = h * sum;
        }
    }

    template <std::size_t i>
    static constexpr bool uses() noexcept
    {
        if constexpr (requires { Tableau::interpolant; })
            return detail::is_interpolated<Tableau, i>();
        else
            return true;
    }
};

} // namespace lagen
