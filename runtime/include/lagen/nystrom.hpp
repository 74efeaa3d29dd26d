// SPDX-License-Identifier: MIT
/// Embedded pairs of Nystrom for second-order systems, states (x, v) with x' = v:
///   X_i = x + c_i h v + h^2 sum_{j<i} abar_ij F_j,   V_i = v + h sum_{j<i} a_ij F_j,   F_i = f(t + c_i h, X_i, V_i),
///   x1 = x + h v + h^2 sum_i bbar_i F_i,             v1 = v + h sum_i b_i F_i.
/// `lagen::Rkn86{.tolerance = 1e-10}`; where v' = f(t, x) alone:
///             calls a step   and where a value inside it is asked for   order of that value
///   Rkn64           5                         0                                 5
///   Rkn86           8                         3                                 7
///   Rkn1210        17                         5                                10
/// and for v' = f(t, x, v): Rkng54, 6 calls, a value of order 4 inside without another one.
/// Step control is that of verner.hpp. Sources are in the tables of coefficients. Values inside a step are those of
/// Dormand and Prince (Rkn64); of continuous extensions that solve the order conditions (Rkn86, Rkn1210: stages are
/// added at values of an extension of lower order, two orders below, since f enters x times h^2); of Hermite's
/// polynomial of degree 5 (Rkng54).
#pragma once

#include "lagen/integrate/pair_steps.hpp"
#include "lagen/integrate/retract.hpp"
#include "lagen/integrate/stages.hpp"
#include "lagen/run.hpp"

#include "lagen/integrate/rkn1210_coefficients.hpp"
#include "lagen/integrate/rkn64_coefficients.hpp"
#include "lagen/integrate/rkn86_coefficients.hpp"
#include "lagen/integrate/rkng54_coefficients.hpp"

namespace lagen {

/// See integrate/stepper.hpp for what is asked of a stepper.
template <class Tableau, class M>
class NystromStepper : public PairSteps<M, Tableau::order, Tableau::dense_stages, Tableau::end> {
    using Base = PairSteps<M, Tableau::order, Tableau::dense_stages, Tableau::end>;
    using Base::calls_, Base::dense_ready_, Base::error_, Base::fails, Base::k_, Base::scale_, Base::x_;
    static constexpr bool general = requires { Tableau::a; };
    static_assert(
        general ? second_order<M> != SecondOrder::no : second_order<M> == SecondOrder::velocity_free,
        "a Nystrom method needs a model of second order (SecondOrder in lagen/kernel.hpp): x' = v, and but for "
        "Rkng54 a v' that does not depend on v");
    static_assert(moves_by_sums<M>, "a Nystrom method moves its states by sums");

  public:
    using Scalar = typename Base::Scalar;
    using Real = typename Base::Real;
    using State = typename Base::State;
    static constexpr bool abreast = true;
    static constexpr int dense_order = Tableau::dense_order;
    static constexpr int error_order = Tableau::embedded_order + 1; ///< the error of that formula is of it in h
    static constexpr double beta_share = 0.75;

    template <class Method>
    explicit NystromStepper(const Method& method) noexcept : Base(method.control())
    {
    }

    /// A model of run-time size says now of what order it is: not_separable where it is of another one.
    status_t<Scalar> begin(const M& model, Real t, const State& s) noexcept
    {
        if constexpr (requires { model.order_of_system(); }) {
            const SecondOrder found = model.order_of_system();
            if (found == SecondOrder::no || (!general && found != SecondOrder::velocity_free))
                return Status::not_separable;
        }
        return Base::begin(model, t, s);
    }

    status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        dense_ready_ = false;
        calls_ += ends_in_stage ? end : end - 1;
        if constexpr (!general) keep_rates(s, x_);
        auto status = evaluate<1, end>(model, t, s, h);
        if (fails(status)) return status;
        move_positions<Tableau::bbar, 0, end>(s, h, h, s1);
        // Of x'' = f(t, x) the last stage does not ask for v1, which may depend on it.
        if constexpr (ends_in_stage && !general) {
            keep_rates(s, s1);
            status = Lanes::first(status, model.rhs(t + h, s1, k_[end]));
        }
        move_rates<Tableau::b, 0, Tableau::stages>(s, h, s1);
        if constexpr (ends_in_stage && general) status = Lanes::first(status, model.rhs(t + h, s1, k_[end]));
        if (fails(status)) return status;
        estimate(s, h, s1);
        status = Lanes::first(status, detail::check_finite(s1));
        if (!ends_in_stage || fails(status)) return status;
        return Lanes::first(status, detail::check_finite(k_[end]));
    }

    /// The derivative at the end of a step that will be accepted.
    status_t<Scalar> finish(const M& model, Real t1, const State& s1) noexcept
    {
        if constexpr (ends_in_stage) {
            for_positions(s1, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
                detail::store(k_[end], lane, detail::load<width>(s1, half(s1) + lane));
            });
            return Lanes::good();
        }
        return Base::finish(model, t1, s1);
    }

    /// v(theta) = v + h sum_i b_i(theta) F_i, x(theta) = x + theta h v + h^2 sum_i F_i int_0^theta b_i. Evaluates the
    /// stages behind the end once a step.
    Status interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        if (!dense_ready_) {
            calls_ += all - 1 - end;
            const Status status = evaluate<end + 1, all>(model, t, s, h);
            if (status != Status::ok) return status;
            dense_ready_ = true;
        }
        out = s;
        add_stages(h, theta, out, std::make_index_sequence<all>{});
        return detail::check_finite(out);
    }

  private:
    using Lanes = StatusOf<Scalar>;
    static constexpr std::size_t end = Tableau::end, all = Tableau::dense_stages;
    static constexpr bool ends_in_stage = end < Tableau::stages;

    /// The number of positions: lane `lane` of x has lane half + lane as its rate.
    static Eigen::Index half(const State& s) noexcept { return s.size() / 2; }

    template <class Function>
    [[gnu::always_inline]] static void for_positions(const State& s, const Function& f) noexcept
    {
        constexpr Eigen::Index size = State::SizeAtCompileTime;
        detail::for_first_lanes<State, (size > 0 ? size / 2 : -1)>(half(s), f);
    }

    /// The rates of `out` are those of s.
    [[gnu::always_inline]] static void keep_rates(const State& s, State& out) noexcept
    {
        for_positions(s, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            detail::store(out, half(s) + lane, detail::load<width>(s, half(s) + lane));
        });
    }

    /// x + reach v + h^2 sum_j weights[offset + j] F_j, j < count.
    template <auto& weights, std::size_t offset, std::size_t count>
    [[gnu::always_inline]] void move_positions(const State& s, const Real& h, const Real& reach,
                                               State& out) const noexcept
    {
        const Real square = h * h;
        for_positions(s, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            const auto stages = std::make_index_sequence<count>{};
            const auto sum = detail::weighted_lanes<weights, offset, width>(square, k_, half(s) + lane, stages);
            const detail::Slice<State, width> move = reach * detail::load<width>(s, half(s) + lane) + sum;
            detail::store(out, lane, detail::load<width>(s, lane) + move);
        });
    }

    /// v + h sum_j weights[offset + j] F_j, j < count.
    template <auto& weights, std::size_t offset, std::size_t count>
    [[gnu::always_inline]] void move_rates(const State& s, const Real& h, State& out) const noexcept
    {
        for_positions(s, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            const auto stages = std::make_index_sequence<count>{};
            const auto sum = detail::weighted_lanes<weights, offset, width>(h, k_, half(s) + lane, stages);
            detail::store(out, half(s) + lane, detail::load<width>(s, half(s) + lane) + sum);
        });
    }

    /// Stages first..last-1.
    template <std::size_t first, std::size_t last>
    [[gnu::always_inline]] status_t<Scalar> evaluate(const M& model, const Real& t, const State& s,
                                                     const Real& h) noexcept
    {
        if constexpr (first < last) {
            constexpr std::size_t row = detail::lower_index(first, 0);
            const Real reach = Tableau::c[first].template as<real_t<Real>>() * h;
            move_positions<Tableau::abar, row, first>(s, h, reach, x_);
            if constexpr (general) move_rates<Tableau::a, row, first>(s, h, x_);
            const auto status = model.rhs(t + reach, x_, k_[first]);
            return fails(status) ? status : Lanes::first(status, evaluate<first + 1, last>(model, t, s, h));
        }
        return Lanes::good();
    }

    /// The norm of h^2 sum_i error_bar_i F_i and h sum_i error_i F_i.
    void estimate(const State& s, Real h, const State& s1) noexcept
    {
        using std::sqrt;
        const Real square = h * h;
        Real sum = Real(0);
        for_positions(s, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            using Slice = detail::Slice<State, width>;
            const auto stages = std::make_index_sequence<Tableau::stages>{};
            const Eigen::Index rate = half(s) + lane;
            const Slice ex = detail::weighted_lanes<Tableau::error_bar, 0, width>(square, k_, rate, stages) /
                             scale_.template of<width>(s, s1, lane);
            const Slice ev = detail::weighted_lanes<Tableau::error, 0, width>(h, k_, rate, stages) /
                             scale_.template of<width>(s, s1, rate);
            sum = detail::sum_with(sum, Slice(ex * ex + ev * ev));
        });
        error_ = sqrt(sum / Real(static_cast<real_t<Real>>(s.size())));
    }

    /// s, in `out`, moved to theta.
    template <std::size_t... i>
    void add_stages(const Real& h, const Real& theta, State& out, std::index_sequence<i...>) const noexcept
    {
        std::array<Real, all> b{}, bbar{};
        ((b[i] = detail::interpolant_weight<Tableau, i>(theta)), ...);
        ((bbar[i] = detail::interpolant_integral<Tableau, i>(theta)), ...);
        for (Eigen::Index lane = 0, rate = half(out); lane < half(out); ++lane, ++rate) {
            Real v = Real(0), x = Real(0);
            const auto add = [&]<std::size_t stage>() {
                if constexpr (detail::is_interpolated<Tableau, stage>()) {
                    v += b[stage] * this->k_[stage][rate];
                    x += bbar[stage] * this->k_[stage][rate];
                }
            };
            (add.template operator()<i>(), ...);
            out[lane] += h * (theta * out[rate] + h * x);
            out[rate] += h * v;
        }
    }
};

template <class Tableau>
struct NystromFamily {
    static constexpr StepControl defaults{.safety = 0.8, .beta = 0};
    template <class M>
    using Stepper = NystromStepper<Tableau, M>;
};

using Rkn64 = AdaptiveMethod<NystromFamily<tableau::Rkn64>>;
using Rkn86 = AdaptiveMethod<NystromFamily<tableau::Rkn86>>;
using Rkn1210 = AdaptiveMethod<NystromFamily<tableau::Rkn1210>>;
using Rkng54 = AdaptiveMethod<NystromFamily<tableau::Rkng54>>;

} // namespace lagen
