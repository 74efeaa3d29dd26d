// SPDX-License-Identifier: MIT
/// Gauss' collocation methods with a fixed step, `lagen::Gauss6{.step = 0.01}`, and Radau IIA of orders 3 and 5 with
/// a fixed step. Gauss' methods are symplectic, symmetric and keep every quadratic invariant; Radau IIA damps what is
/// stiff.
///
/// Every step solves its equations by Newton's method, with the Jacobian at the beginning of the step, until the
/// increments are rounding errors: what is kept is kept to rounding, and rounding errors are all that is left to add
/// up. An iteration that converges slowly gets the Jacobian at an estimate of the step's middle; a step whose iteration
/// does not converge is tried once more from there, then fails with `newton_diverged`. Methods of more than four stages
/// (of four with packs) iterate Z_i = h sum_j a_ij f(s + Z_j) without a Jacobian first, to rounding too, all stages of
/// a generated model in the lanes of packs (lanes/packed_stages.hpp); a step in which that is slow is left to Newton's
/// method, and so are some steps behind it. Where the method is `compensated`, the rounding error of the sum s1 = s +
/// .. enters the next step [Kahan 1965], so that errors grow as Brouwer's law says [Hairer, McLachlan, Razakarivony,
/// BIT 48 (2008) 231]. A value inside a step is a shorter step of the same method, begun with this step's collocation
/// polynomial: it has the full order. Should Newton's method fail there, it is the value of the polynomial (order: the
/// number of stages).
#pragma once

#include "lagen/integrate/convergence.hpp"
#include "lagen/integrate/stage_equations.hpp"
#include "lagen/lanes/packed_stages.hpp"
#include "lagen/run.hpp"

namespace lagen {

/// The stepper of a collocation method: see integrate/stepper.hpp for what is asked of it.
template <class Scheme, class M>
class CollocationStepper {
  public:
    using Real = typename M::Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int order = Scheme::order;
    static constexpr int dense_order = Scheme::order;
    static constexpr std::size_t stages = Scheme::stages;
    static constexpr int most_iterations = 100;
    static constexpr int most_refreshments = 5; ///< of the Jacobian in a step

    template <class Method>
    explicit CollocationStepper(const Method& method) : compensated_(method.compensated)
    {
    }

    /// No derivative is kept from step to step; the first step begins without a prediction.
    Status begin(const M& model, Real, const State& s) noexcept
    {
        const Status status = equations_.begin(model, s);
        if (status != Status::ok) return status;
        lost_ = State::Zero(s.size());
        next_lost_ = lost_;
        middle_ = lost_;
        convergence_.begin(lost_);
        for (State& stage : z_) stage = lost_;
        inner_ = z_;
        if constexpr (may_pack) packs_.begin(model, s.size());
        return Status::ok;
    }

    Status attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        predict(h);
        h_ = h;
        const Status status = solve(model, t, s, h);
        if (status != Status::ok) return status;
        detail::for_each_lane(s, [&](Eigen::Index lane) {
            const Real increment = gain(z_, lane) - lost_[lane];
            s1[lane] = s[lane] + increment;
            next_lost_[lane] = (s1[lane] - s[lane]) - increment;
        });
        return detail::check_finite(s1);
    }

    void accept() noexcept
    {
        if (compensated_) lost_ = next_lost_;
        last_h_ = h_;
    }

    /// After a step that failed: its stages predict nothing.
    void forget() noexcept
    {
        last_h_ = Real(0);
        for (State& stage : z_) stage.setZero();
    }

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    Status interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        const Real length = theta * h;
        const auto guess = [&] {
            for (std::size_t i = 0; i < stages; ++i) polynomial(Real(theta * equations_.method().c[i]), inner_[i]);
        };
        guess();
        bool solved = simple() && iterate_simply(model, t, s, length, inner_) == Status::ok;
        if (!solved && simple()) equations_.linearise(model, t, s), guess();
        solved = solved ||
                 (equations_.factor(length) && iterate(model, t, s, length, inner_, most_refreshments) == Status::ok);
        if (solved) {
            for (Eigen::Index lane = 0; lane < s.size(); ++lane)
                out[lane] = s[lane] + (gain(inner_, lane) - lost_[lane]);
        } else {
            polynomial(theta, out);
            out += s;
        }
        return detail::check_finite(out);
    }

    /// What the polynomial of the last step has more than its beginning.
    bool polynomial(const Real& theta, State& out) const noexcept
    {
        Weights weights;
        detail::collocation_weights(equations_.method().c, theta, weights);
        combine(weights, out);
        return true;
    }

    [[nodiscard]] std::size_t calls() const noexcept { return equations_.calls; }
    [[nodiscard]] std::size_t newton_iterations() const noexcept { return equations_.iterations; }
    [[nodiscard]] std::size_t decompositions() const noexcept { return equations_.decompositions; }

  private:
    using Stages = std::array<State, stages>;
    static constexpr bool may_pack = stages >= 4 && (detail::TakesPacks<M> || detail::OffersPacks<M>);
    static constexpr int longest_wait = 63;
    using Packs = std::conditional_t<may_pack, detail::PackedStages<stages, M>, detail::NoPacks>;

    /// Are the stages of the iteration without a Jacobian lanes of packs?
    [[nodiscard]] bool packed() const noexcept
    {
        if constexpr (may_pack) return packs_.is_offered();
        return false;
    }
    /// Does an iteration without a Jacobian come first?
    [[nodiscard]] bool simple() const noexcept { return stages > 4 || packed(); }

    /// s1 - s of a lane, of stages that have converged.
    Real gain(const Stages& z, Eigen::Index lane) const noexcept
    {
        // Slopes of stiff problems carry the rounding errors of the stages times the Jacobian.
        if constexpr (Scheme::stiffly_accurate) return z.back()[lane];
        Real sum = equations_.slopes[0][lane];
        for (std::size_t j = 1; j < stages; ++j) sum += equations_.slopes[j][lane];
        return equations_.times_length(sum);
    }

    using Weights = std::array<Real, stages>;

    /// The sum of weights times the stages of the last step.
    void combine(const Weights& weights, State& out) const noexcept
    {
        detail::for_each_lane(out, [&](Eigen::Index lane) {
            Real sum = weights[0] * z_[0][lane];
            for (std::size_t j = 1; j < stages; ++j) sum += weights[j] * z_[j][lane];
            out[lane] = sum;
        });
    }

    /// The stages of a step of length h from the collocation polynomial of the step before; of the first step: s.
    void predict(const Real& h) noexcept
    {
        if (last_h_ == Real(0)) return;
        const auto& c = equations_.method().c;
        if (const Real ratio = h / last_h_; ratio != ratio_) {
            ratio_ = ratio;
            detail::collocation_weights(c, Real(1), at_end_);
            for (std::size_t i = 0; i < stages; ++i)
                detail::collocation_weights(c, Real(Real(1) + ratio * c[i]), ahead_[i]);
        }
        combine(at_end_, middle_);
        for (std::size_t i = 0; i < stages; ++i) {
            combine(ahead_[i], inner_[i]);
            inner_[i] -= middle_;
        }
        z_ = inner_;
    }

    /// Stages in z_, which have the prediction. Where the iteration without a Jacobian fails, some steps do without it,
    /// twice as many as the last time.
    Status solve(const M& model, const Real& t, const State& s, const Real& h) noexcept
    {
        if (simple() && waiting_-- <= 0) {
            inner_ = z_;
            const bool solved = iterate_simply(model, t, s, h, inner_) == Status::ok;
            wait_ = solved ? 0 : std::min(2 * wait_ + 1, longest_wait);
            waiting_ = wait_;
            if (solved) return z_ = inner_, Status::ok;
        }
        const Status status = try_from(model, t, s, h, most_refreshments);
        if (status == Status::ok) return status;
        // Rarely, a Jacobian that stays as it is leads to stages that better ones lead away from.
        for (State& stage : z_) stage.setZero();
        return try_from(model, t, s, h, 0);
    }

    /// Newton's method from z_ with the Jacobian at the beginning of the step, then, where it fails, once more.
    Status try_from(const M& model, const Real& t, const State& s, const Real& h, int refreshments) noexcept
    {
        equations_.linearise(model, t, s);
        if (equations_.factor(h) && iterate(model, t, s, h, z_, refreshments) == Status::ok) return Status::ok;
        return try_again(model, t, s, h, refreshments);
    }

    /// One step of Newton's method from the state itself solves the linearised equations; the mean of its stages is an
    /// estimate of the middle of the step. Where that step does not exist, Euler's stages are taken.
    Status try_again(const M& model, const Real& t, const State& s, const Real& h, int refreshments) noexcept
    {
        const auto& method = equations_.method();
        for (State& stage : z_) stage.setZero();
        const Status status = equations_.evaluate(model, t, s, lost_, z_);
        if (status != Status::ok) return status;
        inner_ = equations_.slopes;
        if (equations_.factor(h)) {
            equations_.solve();
            z_ = equations_.residuals;
        } else {
            for (std::size_t i = 0; i < stages; ++i) z_[i] = (h * method.c[i] / method.b[i]) * inner_[i];
        }
        return linearise_middle(model, t, s, h, z_) ? iterate(model, t, s, h, z_, refreshments)
                                                    : Status::newton_diverged;
    }

    /// Newton's method from z until the increments of every lane are rounding errors. One that converges slowly gets
    /// the Jacobian at an estimate of the middle of the step from where it is.
    Status iterate(const M& model, const Real& t, const State& s, const Real& h, Stages& z, int refreshments) noexcept
    {
        measure(s, h);
        const auto round = [&](Real& size) {
            const Status status = equations_.evaluate(model, t, s, lost_, z);
            if (status != Status::ok) return status;
            equations_.solve();
            size = move(z);
            return size - size == Real(0) ? Status::ok : equations_.runaway();
        };
        return converge(round, [&] {
            if (refreshments-- <= 0) return true;
            if (!linearise_middle(model, t, s, h, z)) return false;
            measure(s, h);
            convergence_.renew();
            return true;
        });
    }

    /// The same without a Jacobian, where that converges well.
    Status iterate_simply(const M& model, const Real& t, const State& s, const Real& h, Stages& z) noexcept
    {
        equations_.set_length(h);
        detail::for_each_lane(s,
                              [&](Eigen::Index lane) { convergence_.scale[lane] = detail::magnitude(Real(s[lane])); });
        const auto finite = [](const Real& size) {
            return size - size == Real(0) ? Status::ok : Status::newton_diverged;
        };
        const auto never = [] { return false; };
        if constexpr (may_pack)
            if (packed()) {
                packs_.load(z);
                const auto round = [&](Real& size) {
                    equations_.calls += stages;
                    if (!packs_.evaluate(model, t, h, s, lost_)) return Status::newton_diverged;
                    size = packs_.move(convergence_, [&](const auto& a) { return equations_.times_length(a); });
                    return finite(size);
                };
                const Status status = converge(round, never);
                if (status == Status::ok) packs_.unload(z, equations_.slopes);
                return status;
            }
        const auto round = [&](Real& size) {
            const Status status = equations_.evaluate(model, t, s, lost_, z);
            if (status != Status::ok) return status;
            size = move(z);
            return finite(size);
        };
        return converge(round, never);
    }

    /// Rounds until their increments, the largest relative one of which a round writes, are rounding errors; refresh()
    /// is asked whether to go on where they fall slowly.
    template <class Round, class Refresh>
    Status converge(const Round& round, const Refresh& refresh) noexcept
    {
        using Verdict = typename detail::Convergence<State>::Verdict;
        convergence_.start();
        for (int k = 0; k < most_iterations; ++k) {
            Real size = Real(0);
            const Status status = round(size);
            if (status != Status::ok) return status;
            const Verdict verdict = convergence_.judge(size);
            if (verdict == Verdict::done) return Status::ok;
            if (verdict == Verdict::diverged || (verdict == Verdict::slow && !refresh())) break;
        }
        return Status::newton_diverged;
    }

    /// Increments are rounding errors of |s| + |h J| |s|.
    void measure(const State& s, const Real& h) noexcept
    {
        State& scale = convergence_.scale;
        equations_.row_sizes(s, scale);
        detail::for_each_lane(s, [&](Eigen::Index lane) {
            scale[lane] = detail::magnitude(s[lane]) + detail::magnitude(h) * scale[lane];
        });
    }

    /// The Jacobian at s + sum_j b_j Z_j; false where it cannot be decomposed.
    bool linearise_middle(const M& model, const Real& t, const State& s, const Real& h, const Stages& z) noexcept
    {
        middle_ = s;
        for (std::size_t i = 0; i < stages; ++i) middle_ += equations_.method().b[i] * z[i];
        equations_.linearise(model, t + h / Real(2), middle_);
        return equations_.factor(h);
    }

    /// z += increments; answers the largest one relative to what it is a rounding error of: |s| + |Z| + |h J| |s|. No
    /// number where an increment is none.
    Real move(Stages& z) noexcept
    {
        using detail::load;
        using detail::size_of;
        Real largest = Real(0), sum = Real(0);
        const auto& increments = detail::held<0, stages>(equations_.residuals);
        detail::for_lanes(middle_, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            using Slice = detail::Slice<State, width>;
            Slice step = detail::uniform<State, width>(Real(0)), reach = step, all = step;
            detail::write_out<stages>([&](auto i) {
                const Slice increment = load<width>(increments[i], lane);
                const Slice moved = load<width>(z[i], lane) + increment;
                detail::store(z[i], lane, moved);
                const Slice size = size_of(increment), far = size_of(moved);
                step = size > step ? size : step;
                reach = far > reach ? far : reach;
                all += increment;
            });
            const Slice relative = convergence_.template note<width>(lane, step, reach);
            sum = detail::sum_with(sum, all);
            largest = std::max<Real>(largest, detail::largest(relative));
        });
        return largest + (sum - sum);
    }

    detail::StageEquations<Scheme, M> equations_;
    Stages z_, inner_;
    State lost_, next_lost_; ///< of the sum, before and behind a step that converged; values inside it leave them alone
    State middle_;
    detail::Convergence<State> convergence_;
    Weights at_end_{};                    ///< of the stages, in Z(1)
    std::array<Weights, stages> ahead_{}; ///< and in the next step's stages, h / last_h_ being ratio_
    Real h_ = Real(0), last_h_ = Real(0), ratio_ = Real(0);
    [[no_unique_address]] Packs packs_{equations_.method()};
    int wait_ = 0, waiting_ = 0; ///< steps without the iteration without a Jacobian: the last time, and left
    bool compensated_;
};

/// A collocation method with a fixed positive `step`; `compensated` carries the rounding errors of the sums along.
template <class Scheme>
struct CollocationMethod {
    double step = 0;
    bool compensated = true;

    template <class M>
    using Stepper = CollocationStepper<Scheme, M>;
};

using Gauss2 = CollocationMethod<detail::GaussScheme<1>>; ///< the implicit midpoint rule
using Gauss4 = CollocationMethod<detail::GaussScheme<2>>;
using Gauss6 = CollocationMethod<detail::GaussScheme<3>>;
using Gauss8 = CollocationMethod<detail::GaussScheme<4>>;
using Gauss12 = CollocationMethod<detail::GaussScheme<6>>;
using Gauss16 = CollocationMethod<detail::GaussScheme<8>>;
using Radau3Fixed = CollocationMethod<detail::RadauScheme<2>>;
using Radau5Fixed = CollocationMethod<detail::RadauScheme<3>>;

} // namespace lagen
