// SPDX-License-Identifier: MIT
/// `lagen::Dop853{.tolerance = 1e-10}`: order 8 with error estimates of order 5 and 3 and dense output of order 7
/// [Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.5 and II.10; code dop853.f].
/// Twelve calls a step; three more in a step where a value inside it is asked for.
/// The coefficients have 40 digits: `__float128` and wider scalars get the accuracy that they ask for.
#pragma once

#include "lagen/integrate/dop853_coefficients.hpp"
#include "lagen/integrate/pair_steps.hpp"
#include "lagen/integrate/stages.hpp"
#include "lagen/run.hpp"

namespace lagen {

/// See integrate/stepper.hpp for what is asked of a stepper.
template <class M>
class Dop853Stepper : public PairSteps<M, 8, tableau::Dop853::dense_stages, tableau::Dop853::end> {
    using Base = PairSteps<M, 8, tableau::Dop853::dense_stages, tableau::Dop853::end>;
    static_assert(moves_by_sums<M>,
                  "the dense output of this method is made of sums: use Dopri5, or a fixed-step method");

  public:
    using Scalar = typename Base::Scalar;
    using Real = typename Base::Real;
    using State = typename Base::State;
    static constexpr bool abreast = true;
    using Tableau = tableau::Dop853;
    static constexpr int dense_order = Tableau::dense_order;
    static constexpr int error_order = 8; ///< err5^2 / err3 is of this order in h
    static constexpr double beta_share = 0.2;

    template <class Method>
    explicit Dop853Stepper(const Method& method) noexcept : Base(method.control())
    {
    }

    status_t<Scalar> begin(const M& model, Real t, const State& s) noexcept
    {
        const auto status = Base::begin(model, t, s);
        for (State& coefficient : dense_) coefficient = x_;
        return status;
    }

    status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        calls_ += 11;
        dense_ready_ = false;
        const auto status = detail::evaluate_stages<Tableau, 1, 12>(model, t, s, h, x_, k_);
        if (fails(status)) return status;
        detail::move_along<Tableau::a, detail::lower_index(12, 0), 12>(model, s, h, k_, s1);
        estimate(model, t, s, h, s1);
        return StatusOf<Scalar>::first(status, detail::check_finite(s1));
    }

    /// Hairer's nested form: s + u (r2 + v (r3 + u (r4 + v (r5 + u (r6 + v (r7 + u r8)))))), u = theta, v = 1 - theta.
    Status interpolate(const M& model, Real t, const State& s, Real h, const State& s1, Real theta, State& out) noexcept
    {
        if (!dense_ready_) {
            const Status status = prepare_dense(model, t, s, h, s1);
            if (status != Status::ok) return status;
        }
        const Real rest = Real(1) - theta;
        for (Eigen::Index lane = 0; lane < s.size(); ++lane) {
            Real sum = Real(0);
            for (std::size_t i = dense_.size(); i-- > 0;) sum = (i % 2 == 0 ? theta : rest) * (dense_[i][lane] + sum);
            out[lane] = s[lane] + sum;
        }
        return detail::check_finite(out);
    }

  protected:
    using Base::calls_, Base::dense_ready_, Base::error_, Base::fails, Base::k_, Base::scale_, Base::x_;

  private:
    /// error = |h| err5 / sqrt(n (err5^2 + err3^2 / 100)) err5, norms squared first; a model whose lanes are those of a
    /// chart measures errors itself.
    void estimate([[maybe_unused]] const M& model, [[maybe_unused]] Real t, const State& s, Real h,
                  [[maybe_unused]] const State& s1) noexcept
    {
        using std::sqrt;
        Real five = Real(0), three = Real(0);
        if constexpr (requires { model.squared_error(scale_, t, s); }) {
            detail::weighted_sum<Tableau::error5>(h, k_, x_);
            five = model.squared_error(scale_, t, x_);
            detail::weighted_sum<Tableau::error3>(h, k_, x_);
            three = model.squared_error(scale_, t, x_);
        } else {
            detail::for_lanes(s, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
                using Slice = detail::Slice<State, width>;
                const auto all = std::make_index_sequence<12>{};
                const Slice scale = scale_.template of<width>(s, s1, lane);
                const Slice e5 = detail::weighted_lanes<Tableau::error5, 0, width>(h, k_, lane, all) / scale;
                const Slice e3 = detail::weighted_lanes<Tableau::error3, 0, width>(h, k_, lane, all) / scale;
                five = detail::sum_with(five, Slice(e5 * e5));
                three = detail::sum_with(three, Slice(e3 * e3));
            });
        }
        const Real sum = five + Real(0.01) * three;
        const Real size = sqrt(sum * Real(static_cast<real_t<Real>>(s.size())));
        if constexpr (is_pack<Real>)
            error_ = select(sum > Real(0), five / size, sum);
        else
            error_ = sum > Real(0) ? Real(five / size) : sum;
    }

    Status prepare_dense(const M& model, Real t, const State& s, Real h, const State& s1) noexcept
    {
        calls_ += 3;
        const Status status = detail::evaluate_stages<Tableau, 13, 16>(model, t, s, h, x_, k_);
        if (status != Status::ok) return status;
        for (Eigen::Index lane = 0; lane < s.size(); ++lane) {
            const Real difference = s1[lane] - s[lane];
            const Real bend = h * k_[0][lane] - difference;
            dense_[0][lane] = difference;
            dense_[1][lane] = bend;
            dense_[2][lane] = difference - h * k_[12][lane] - bend;
        }
        detail::weighted_sum<Tableau::dense4>(h, k_, dense_[3]);
        detail::weighted_sum<Tableau::dense5>(h, k_, dense_[4]);
        detail::weighted_sum<Tableau::dense6>(h, k_, dense_[5]);
        detail::weighted_sum<Tableau::dense7>(h, k_, dense_[6]);
        dense_ready_ = true;
        return Status::ok;
    }

    std::array<State, 7> dense_;
};

/// Order 8(5,3); Hairer's classical controller (beta = 0), but with safety 0.8 for his 0.9: over Kepler's problem
/// (e = 0.3 .. 0.99), Arenstorf's orbit, a pendulum near its separatrix, the heavy top and Lotka-Volterra at tolerances
/// 1e-5 .. 1e-12 one step in ten is rejected instead of one in five, and equal errors cost 8 % less. PI control with
/// beta = 0.04 rejects fewer still, but costs more; from 0.08 on the proposed steps shrink without need.
struct Dop853Family {
    static constexpr StepControl defaults{.safety = 0.8, .shrink = 1.0 / 3.0, .grow = 6, .beta = 0};
    template <class M>
    using Stepper = Dop853Stepper<M>;
};

using Dop853 = AdaptiveMethod<Dop853Family>;

} // namespace lagen
