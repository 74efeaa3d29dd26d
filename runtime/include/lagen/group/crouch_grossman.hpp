// SPDX-License-Identifier: MIT
/// `lagen::CrouchGrossman3{.step = h}`: steps along the frozen fields K_j of stages,
///   X_i = exp(h a_i,i-1 K_i-1) .. exp(h a_i1 K_1) s,   s1 = exp(h b_3 K_3) exp(h b_2 K_2) exp(h b_1 K_1) s,
/// each a motion by the group and a translation of the other lanes: no bracket, no chart.
#pragma once

#include "lagen/group/algebra_action.hpp"
#include "lagen/integrate/stages.hpp"
#include "lagen/run.hpp"

namespace lagen {

namespace tableau {

/// Order 3 [Crouch, Grossman, Journal of Nonlinear Science 3 (1993) 1; Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, IV.8.1].
struct CrouchGrossman3 {
    static constexpr std::size_t stages = 3;
    static constexpr int order = 3;
    static constexpr std::array<Fraction, 3> a{{{3, 4}, {119, 216}, {17, 108}}};
    static constexpr std::array<Fraction, 3> b{{{13, 51}, {-2, 3}, {24, 17}}};
    static constexpr std::array<Fraction, 3> c{{{0, 1}, {3, 4}, {17, 24}}};
};

} // namespace tableau

/// The stepper: see integrate/stepper.hpp for what is asked of it.
template <class Tableau, class M>
class FrozenFieldStepper {
    static_assert(!is_pack<typename M::Scalar>, "methods on groups take one trajectory at a time");

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int order = Tableau::order;
    static constexpr int dense_order = Tableau::order;

    template <class Method>
    explicit FrozenFieldStepper(const Method&) noexcept
    {
    }

    Status begin(const M&, const Real&, const State& s) noexcept
    {
        lost_ = next_lost_ = State::Zero(s.size());
        return Status::ok;
    }

    Status attempt(const M& model, const Real& t, const State& s, const Real& h, State& s1) noexcept
    {
        return move(model, t, s, h, s1, next_lost_);
    }

    void accept() noexcept { lost_ = next_lost_; }

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    Status interpolate(const M& model, const Real& t, const State& s, const Real& h, const State&, const Real& theta,
                       State& out) noexcept
    {
        State ignored;
        return move(model, t, s, Real(theta * h), out, ignored);
    }

    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

  private:
    static constexpr auto& free = detail::free_lanes<M>;

    Status move(const M& model, const Real& t, const State& s, const Real& h, State& s1, State& lost) noexcept
    {
        s1 = s;
        for (std::size_t i = 0; i < Tableau::stages; ++i) {
            const Status status = freeze(model, Real(t + Tableau::c[i].template as<Real>() * h), s1, i);
            if (status != Status::ok) return status;
            const bool last = i + 1 == Tableau::stages;
            const auto* const weights = last ? Tableau::b.data() : &Tableau::a[detail::lower_index(i + 1, 0)];
            State increment = -lost_;
            s1 = s + increment;
            for (std::size_t j = 0; j <= i; ++j) {
                increment += along(model, t, s1, j, Real(h * weights[j].template as<Real>()));
                s1 = s + increment;
            }
            lost = (s1 - s) - increment;
        }
        return detail::check_finite(s1);
    }

    /// K_i: xi, and the rates of the other lanes.
    Status freeze(const M& model, const Real& t, const State& x, std::size_t i) noexcept
    {
        ++calls_;
        const Status status = model.algebra_element(t, x, xi_[i]);
        if (free.empty() || status != Status::ok) return status;
        return model.rhs(t, x, rates_[i]);
    }

    /// Where K_j takes x in the time h, less x.
    [[nodiscard]] State along(const M& model, const Real& t, const State& x, std::size_t j,
                              const Real& h) const noexcept
    {
        State increment;
        detail::add_motion<false>(model, t, x, AlgebraElement<M>(h * xi_[j]), increment);
        for (const Eigen::Index lane : free) increment[lane] = h * rates_[j][lane];
        return increment;
    }

    std::array<AlgebraElement<M>, Tableau::stages> xi_;
    std::array<State, Tableau::stages> rates_;
    State lost_, next_lost_; ///< of the sums, before and behind a step
    std::size_t calls_ = 0;
};

struct CrouchGrossman3 {
    double step = 0;

    template <class M>
    using Stepper = FrozenFieldStepper<tableau::CrouchGrossman3, M>;
};

} // namespace lagen
