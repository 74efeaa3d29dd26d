// SPDX-License-Identifier: MIT
/// Partitioned (splitting) methods for separable systems
///   xdot = f(y, t),   ydot = g(x, t),
/// where x are the first M::base_dimension lanes and y the others: compositions of drifts x += a h f(y) and kicks
/// y += b h g(x). Symplectic where x and y are canonical coordinates. Separability is the caller's to know: a probe at
/// the start refuses a right-hand side that plainly is not separable, and can miss one that is only nearly so.
#pragma once

#include "lagen/integrate/lanes.hpp"
#include "lagen/integrate/retract.hpp"
#include "lagen/integrate/tableau.hpp"

namespace lagen {

/// One substep: a drift or a kick of length weight * h.
struct SplitStep {
    bool kick = false;
    Decimal weight;
};

namespace splitting {

/// Stoermer-Verlet, drift-kick-drift.
struct LeapfrogDkd {
    static constexpr int order = 2;
    static constexpr std::array<SplitStep, 3> steps{{{false, {0.5L}}, {true, {1.0L}}, {false, {0.5L}}}};
};

/// Stoermer-Verlet, kick-drift-kick.
struct LeapfrogKdk {
    static constexpr int order = 2;
    static constexpr std::array<SplitStep, 3> steps{{{true, {0.5L}}, {false, {1.0L}}, {true, {0.5L}}}};
};

/// Four stages, kick first [McLachlan and Atela 1992, table 1].
struct McLachlan4 {
    static constexpr int order = 4;
    static constexpr std::array<SplitStep, 8> steps{{
        {true, {0.134496199277431089L}},
        {false, {0.515352837431122936L}},
        {true, {-0.224819803079420806L}},
        {false, {-0.085782019412973646L}},
        {true, {0.756320000515668291L}},
        {false, {0.441583023616466524L}},
        {true, {0.334003603286321425L}},
        {false, {0.128846158365384185L}},
    }};
};

/// Seven leapfrogs kick-drift-kick with weights w3 w2 w1 w0 w1 w2 w3 [Yoshida 1990, solution A].
struct Yoshida6 {
    static constexpr int order = 6;
    static constexpr long double w1 = -1.17767998417887100694641568096431573L;
    static constexpr long double w2 = 0.235573213359358133684793182978534602L;
    static constexpr long double w3 = 0.784513610477557263819497633866349876L;
    static constexpr long double w0 = 1.0L - 2.0L * (w1 + w2 + w3);
    static constexpr std::array<SplitStep, 15> steps{{
        {true, {w3 / 2}},
        {false, {w3}},
        {true, {(w3 + w2) / 2}},
        {false, {w2}},
        {true, {(w2 + w1) / 2}},
        {false, {w1}},
        {true, {(w1 + w0) / 2}},
        {false, {w0}},
        {true, {(w0 + w1) / 2}},
        {false, {w1}},
        {true, {(w1 + w2) / 2}},
        {false, {w2}},
        {true, {(w2 + w3) / 2}},
        {false, {w3}},
        {true, {w3 / 2}},
    }};
};

} // namespace splitting

/// The stepper of a splitting method: see integrate/integrator.hpp for what is asked of it.
template <class Splitting, class M>
class SplittingStepper {
    static_assert(M::base_dimension > 0 && M::base_dimension < M::dimension,
                  "a partitioned method needs a model with base and fibre lanes");
    static_assert(moves_by_sums<M>, "a partitioned method moves base and fibre lanes by sums");

  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int order = Splitting::order;
    static constexpr int dense_order = Splitting::order;

    template <class Method>
    explicit SplittingStepper(const Method&) noexcept
    {
    }

    /// Probes separability: xdot must not change with x, nor ydot with y, by more than 1e-6 relative. Where the
    /// displaced points cannot be evaluated the probe says nothing.
    status_t<Scalar> begin(const M& model, Real t, const State& s) noexcept
    {
        State here = State::Zero(s.size());
        const auto status = model.rhs(Scalar(t), s, here);
        ds_ = here;
        ++calls_;
        if (!StatusOf<Scalar>::all_good(status)) return status;
        auto verdict = probe(model, t, s, here, 0, M::base_dimension);
        verdict = StatusOf<Scalar>::first(verdict, probe(model, t, s, here, M::base_dimension, M::dimension));
        return verdict;
    }

    status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        s1 = s;
        auto status = StatusOf<Scalar>::good();
        Real time = t;
        for (const SplitStep& substep : Splitting::steps) {
            const Real length = substep.weight.template as<Real>() * h;
            status = StatusOf<Scalar>::first(status, model.rhs(Scalar(time), s1, ds_));
            ++calls_;
            const int begin = substep.kick ? M::base_dimension : 0;
            const int end = substep.kick ? M::dimension : M::base_dimension;
            for (int lane = begin; lane < end; ++lane) s1[lane] += length * ds_[lane];
            if (!substep.kick) time += length;
        }
        return StatusOf<Scalar>::first(status, detail::check_finite(s1));
    }

    void accept() noexcept {}

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    status_t<Scalar> interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta,
                                 State& out) noexcept
    {
        return attempt(model, t, s, theta * h, out);
    }

    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

  private:
    status_t<Scalar> probe(const M& model, Real t, const State& s, const State& here, int begin, int end) noexcept
    {
        State moved = s;
        for (int lane = begin; lane < end; ++lane)
            moved[lane] += Scalar(Real(1) / Real(64)) * (Scalar(1) + s[lane] * s[lane]);
        auto verdict = StatusOf<Scalar>::good();
        const auto status = model.rhs(Scalar(t), moved, ds_);
        ++calls_;
        if (!StatusOf<Scalar>::all_good(status)) return verdict;
        for (int lane = begin; lane < end; ++lane) {
            const Scalar change = ds_[lane] - here[lane];
            const Scalar size = Scalar(1) + here[lane] * here[lane];
            StatusOf<Scalar>::fail(verdict, change * change > Scalar(Real(1e-12)) * size, Status::not_separable);
        }
        return verdict;
    }

    State ds_;
    std::size_t calls_ = 0;
};

/// A splitting method with a fixed positive `step`.
template <class Splitting>
struct SplittingMethod {
    double step = 0;

    template <class M>
    using Stepper = SplittingStepper<Splitting, M>;
};

using LeapfrogDkd = SplittingMethod<splitting::LeapfrogDkd>;
using LeapfrogKdk = SplittingMethod<splitting::LeapfrogKdk>;
using McLachlan4 = SplittingMethod<splitting::McLachlan4>;
using Yoshida6 = SplittingMethod<splitting::Yoshida6>;

} // namespace lagen
