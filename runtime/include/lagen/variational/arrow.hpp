// SPDX-License-Identifier: MIT
/// The arrow h of a Lie groupoid that a momentum determines: F^-L(h) = mu with s(h) = x given. Newton's method moves h
/// along its source fibre, h <- h eta(d) with N d = mu - F^-L(h), N_ab = <-e_b (F^-L_a); eta is Cayley's map or exp.
///
/// The equation may have several solutions, and folds where det N = 0 behind which there are none. The one that is
/// taken is connected with the guess: Newton's method is trusted where its steps shrink by a factor of four and det N
/// keeps its sign, and where the first step is no small part of the arrow, N^-1 R changes by less than half of itself
/// on it and det N keeps its sign at points between; else mu is led from F^-L(guess) to its value, in steps as short as
/// they have to be. A discrete Lagrangian that a scheme made may have inner unknowns w of a step, at which it is
/// stationary; they are found with the arrow, by dL/dw = 0.
#pragma once

#include "lagen/group/retraction.hpp"
#include "lagen/linear.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lagen::detail {

// A X = B for the few unknowns of a step on a group, in place: Gauss's elimination with rows exchanged, where pivots
// are compared relative to the largest entry of their row. PivotedLu (linear.hpp) is for matrices that are looked at
// again, and for packs.

/// Leaves X in B. Answers the sign of det A; 0 where A cannot be told from a singular matrix, and B is of no use then.
template <class S, int N, int K>
[[nodiscard]] [[gnu::always_inline]] inline int eliminate(Eigen::Matrix<S, N, N>& A, Eigen::Matrix<S, N, K>& B) noexcept
{
    using std::abs;
    int sign = 1;
    Eigen::Matrix<S, N, 1> scale;
    for (int i = 0; i < N; ++i) {
        S most(0);
        for (int j = 0; j < N; ++j) most = abs(A(i, j)) > most ? S(abs(A(i, j))) : most;
        if (!(most > S(0))) return 0;
        scale[i] = S(1) / most;
    }
    for (int k = 0; k < N; ++k) {
        int best = k;
        S weight = abs(A(k, k)) * scale[k];
        for (int i = k + 1; i < N; ++i)
            if (const S other = abs(A(i, k)) * scale[i]; other > weight) best = i, weight = other;
        if (!(weight > singular_tolerance<S>(N))) return 0;
        if (best != k) {
            sign = -sign;
            for (int j = k; j < N; ++j) std::swap(A(k, j), A(best, j));
            for (int j = 0; j < K; ++j) std::swap(B(k, j), B(best, j));
            std::swap(scale[k], scale[best]);
        }
        if (A(k, k) < S(0)) sign = -sign;
        const S reciprocal = S(1) / A(k, k);
        for (int i = k + 1; i < N; ++i) {
            const S factor = A(i, k) * reciprocal;
            for (int j = k + 1; j < N; ++j) A(i, j) -= factor * A(k, j);
            for (int j = 0; j < K; ++j) B(i, j) -= factor * B(k, j);
        }
        A(k, k) = reciprocal;
    }
    for (int k = N - 1; k >= 0; --k)
        for (int j = 0; j < K; ++j) {
            for (int i = k + 1; i < N; ++i) B(k, j) -= A(k, i) * B(i, j);
            B(k, j) *= A(k, k);
        }
    return sign;
}

} // namespace lagen::detail

namespace lagen {

// The parts of an arrow of a Lie groupoid in the state of a discrete motion: where they stand, how they move along the
// source fibre, how W is kept in its group, and what they are rounded by.

namespace detail {

/// Where the parts of the state of a discrete motion stand: x, x_next - x, W - 1 by rows, w, mu.
template <DiscreteMotion M>
struct ArrowLanes {
    static constexpr int n = M::base_dimension;
    static constexpr int horizontal = M::horizontal;
    static constexpr int order = M::group_order;
    static constexpr int inner = M::inner_dimension;
    static constexpr int rank = M::fibre_dimension;
    static constexpr int unknowns = rank + inner;
    static constexpr int next = n, element = n + horizontal, within = element + order * order, momenta = within + inner;
    static_assert(momenta + rank == M::dimension);
};

/// W - 1, by rows behind lane `element`.
template <DiscreteMotion M>
[[nodiscard]] auto group_part(const typename M::State& s) noexcept
{
    using Lanes = ArrowLanes<M>;
    GroupMatrix<typename M::Scalar, Lanes::order> V;
    for (int i = 0; i < Lanes::order; ++i)
        for (int j = 0; j < Lanes::order; ++j) V(i, j) = s[Lanes::element + i * Lanes::order + j];
    return V;
}

template <DiscreteMotion M>
void set_group_part(typename M::State& s, const GroupMatrix<typename M::Scalar, ArrowLanes<M>::order>& V) noexcept
{
    using Lanes = ArrowLanes<M>;
    for (int i = 0; i < Lanes::order; ++i)
        for (int j = 0; j < Lanes::order; ++j) s[Lanes::element + i * Lanes::order + j] = V(i, j);
}

/// True where h is the step of the model, up to what times of the size of t are rounded by.
template <DiscreteMotion M>
[[nodiscard]] bool is_own_step(const M& model, const step_time_t<M>& t, const step_time_t<M>& h) noexcept
{
    using std::abs;
    using Real = step_time_t<M>;
    const Real length(model.step()), slack = Real(64) * std::numeric_limits<Real>::epsilon();
    return abs(h - length) <= slack * (abs(t) + length);
}

/// The arrow of s moved along its source fibre, h <- h eta(d), and w by the rest of d; false where eta has no value.
template <DiscreteMotion M>
[[nodiscard]] bool move_arrow(const M& model, const typename M::Scalar& t, typename M::State& s,
                              const Eigen::Matrix<typename M::Scalar, ArrowLanes<M>::unknowns, 1>& d) noexcept
{
    using S = typename M::Scalar;
    using Lanes = ArrowLanes<M>;
    if constexpr (Lanes::order > 0) {
        GroupMatrix<S, Lanes::order> step;
        if constexpr (M::cayley)
            step = model.cayley_step(t, s, d.template head<Lanes::rank>());
        else
            step = exp_less_one<S, Lanes::order>(model.algebra_matrix(t, s, d.template head<Lanes::rank>()));
        if (!step.allFinite()) return false;
        const GroupMatrix<S, Lanes::order> V = group_part<M>(s);
        set_group_part<M>(s, V + step + V * step);
    }
    for (int i = 0; i < Lanes::horizontal; ++i) s[Lanes::next + i] += d[i];
    for (int k = 0; k < Lanes::inner; ++k) s[Lanes::within + k] += d[Lanes::rank + k];
    return true;
}

/// W - 1 of the element of the group that the coordinates of W around 1 lead to; false where they have no value.
template <DiscreteMotion M>
[[nodiscard]] bool element_of_coordinates(const M& model, const typename M::Scalar& t, const typename M::State& s,
                                          GroupMatrix<typename M::Scalar, ArrowLanes<M>::order>& renewed) noexcept
{
    using S = typename M::Scalar;
    using Lanes = ArrowLanes<M>;
    if constexpr (M::cayley) {
        renewed = model.cayley_step(t, s, model.cayley_coordinates(t, s));
    } else {
        GroupMatrix<S, Lanes::order> A;
        if (!log_of_one_and<S, Lanes::order>(group_part<M>(s), A)) return false;
        renewed = exp_less_one<S, Lanes::order>(model.algebra_matrix(t, s, model.in_algebra(A)));
    }
    return true;
}

/// Takes W back to its group, from which products of many steps lead away by their rounding. Where the chart around 1
/// does not reach W it stays as it is.
template <DiscreteMotion M>
void renew_group_part(const M& model, const typename M::Scalar& t, typename M::State& s) noexcept
{
    using S = typename M::Scalar;
    using Lanes = ArrowLanes<M>;
    if constexpr (Lanes::order > 0) {
        GroupMatrix<S, Lanes::order> renewed;
        if (!element_of_coordinates(model, t, s, renewed)) return;
        // Beside the edge of the chart it is worse than what it renews.
        using std::sqrt;
        const S near = S(sqrt(std::numeric_limits<real_t<S>>::epsilon()));
        if ((renewed - group_part<M>(s)).cwiseAbs().maxCoeff() <= near) set_group_part<M>(s, renewed);
    }
}

/// True where W is plainly no element of the group: what its coordinates around 1 lead to is another matrix. Where the
/// chart does not reach W, or hardly, nothing is said.
template <DiscreteMotion M>
[[nodiscard]] bool is_off_group(const M& model, const typename M::Scalar& t, const typename M::State& s) noexcept
{
    using S = typename M::Scalar;
    using Lanes = ArrowLanes<M>;
    if constexpr (Lanes::order > 0) {
        constexpr double tolerance = 1e-6, far = 1e3;
        const GroupMatrix<S, Lanes::order> V = group_part<M>(s);
        if constexpr (M::cayley) {
            const auto d = model.cayley_coordinates(t, s);
            if (!d.allFinite() || d.cwiseAbs().maxCoeff() > S(far)) return false;
        } else if (V.cwiseAbs().maxCoeff() > S(1)) {
            return false;
        }
        GroupMatrix<S, Lanes::order> renewed;
        return element_of_coordinates(model, t, s, renewed) && (renewed - V).cwiseAbs().maxCoeff() > S(tolerance);
    } else {
        return false;
    }
}

/// Of x_next - x, W - 1 and w.
template <DiscreteMotion M>
[[nodiscard]] typename M::Scalar largest_part(const typename M::State& z) noexcept
{
    using Lanes = ArrowLanes<M>;
    return z.template segment<Lanes::momenta - Lanes::next>(Lanes::next).cwiseAbs().maxCoeff();
}

template <DiscreteMotion M>
using ArrowColumn = Eigen::Matrix<typename M::Scalar, ArrowLanes<M>::unknowns, 1>;

/// Of the arrow along each unknown: that of its largest part, but of x_next - x no more than |x| there, so that a slow
/// coordinate beside a fast one is found as well; of W - 1 no more than 1.
template <DiscreteMotion M>
[[nodiscard]] ArrowColumn<M> sizes_along(const typename M::State& z) noexcept
{
    using std::abs;
    using S = typename M::Scalar;
    using Lanes = ArrowLanes<M>;
    const S most = largest_part<M>(z);
    ArrowColumn<M> sizes = ArrowColumn<M>::Constant(most);
    for (int b = 0; b < Lanes::horizontal; ++b)
        sizes[b] = std::max<S>(abs(z[Lanes::next + b]), std::min<S>(most, abs(z[b])));
    if constexpr (Lanes::horizontal + Lanes::inner > 0 && Lanes::order > 0) {
        const S turn = z.template segment<Lanes::within - Lanes::element>(Lanes::element).cwiseAbs().maxCoeff();
        for (int b = Lanes::horizontal; b < Lanes::rank; ++b) sizes[b] = std::max<S>(turn, std::min<S>(most, S(1)));
    }
    return sizes;
}

/// True where a step of Newton's method is so small a part of the arrow, along each unknown.
template <DiscreteMotion M>
[[nodiscard]] bool is_part(const ArrowColumn<M>& d, const ArrowColumn<M>& sizes,
                           const typename M::Scalar& part) noexcept
{
    using std::abs;
    for (int b = 0; b < ArrowLanes<M>::unknowns; ++b)
        if (!(abs(d[b]) <= part * sizes[b])) return false;
    return true;
}

/// Of the terms of the equations, mu and N (h - 1): what they are rounded by are parts of these.
template <DiscreteMotion M>
[[nodiscard]] ArrowColumn<M>
sizes_of_terms(const Eigen::Matrix<typename M::Scalar, ArrowLanes<M>::unknowns, ArrowLanes<M>::unknowns>& N,
               const ArrowColumn<M>& sizes, const typename M::State& z) noexcept
{
    using std::abs;
    using Lanes = ArrowLanes<M>;
    ArrowColumn<M> terms = N.cwiseAbs() * sizes;
    for (int a = 0; a < Lanes::rank; ++a) terms[a] += abs(z[Lanes::momenta + a]);
    return terms;
}

/// Of x_next, W and w themselves, which at rest is all that there is: x_next - x and W - 1 are 0 there, and what is
/// left of the equations are the roundings of their terms.
template <DiscreteMotion M>
[[nodiscard]] typename M::Scalar size_of_ends(const typename M::State& z) noexcept
{
    using std::abs;
    using S = typename M::Scalar;
    using Lanes = ArrowLanes<M>;
    S most = std::max<S>(largest_part<M>(z), S(Lanes::order > 0 ? 1 : 0));
    for (int i = 0; i < Lanes::n; ++i) most = std::max<S>(most, abs(z[i]));
    return most;
}

} // namespace detail

template <DiscreteMotion M>
class ArrowSolver {
  public:
    using Scalar = typename M::Scalar;
    using State = typename M::State;
    static constexpr int rank = M::fibre_dimension + M::inner_dimension; ///< of the equations
    using Column = Eigen::Matrix<Scalar, rank, 1>;

    /// Solves for the arrow of `s`, from the one that stands there; its base point and momenta stay. `before`: the
    /// arrow of the step before where the guess goes on from it, by the move `ahead`. What fails leaves `s` as it is:
    /// @return singular_mass_matrix where N is singular at the guess; no_solution where mu lies behind a fold;
    ///         branch_lost where no way is found along which det N keeps the sign that it had; newton_diverged;
    ///         non_finite.
    [[nodiscard]] Status solve(const M& model, const Scalar& t, State& s, const State* before = nullptr,
                               const Column& ahead = Column::Zero()) noexcept
    {
        State z = s;
        moved_ = ahead;
        shift_.setZero();
        points_ = before != nullptr ? 3 : most_points;
        const Status status = newton(model, t, z, before != nullptr);
        if (status == Status::ok) return s = z, status;
        points_ = most_points;
        z = s;
        if (before != nullptr)
            for (int k = Lanes::next; k < Lanes::momenta; ++k) z[k] = (*before)[k];
        const Status led = lead(model, t, z, before != nullptr);
        if (led == Status::ok) s = z;
        return led;
    }

    /// The sum of the moves to the arrow that was found: from `before`, or from the guess where there is none.
    [[nodiscard]] const Column& moved() const noexcept { return moved_; }
    [[nodiscard]] std::size_t evaluations() const noexcept { return evaluations_; }
    [[nodiscard]] std::size_t decompositions() const noexcept { return decompositions_; }

  private:
    using Lanes = detail::ArrowLanes<M>;
    using Real = real_t<Scalar>;
    static constexpr int most_steps = 30, most_points = 12;
    static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

    /// What is left of R = (mu - F^-L(h), -dL/dw), and N; false where they are no finite numbers.
    [[nodiscard]] bool evaluate(const M& model, const Scalar& t, const State& z) noexcept
    {
        ++evaluations_;
        model.arrow_equation(t, z, residual_, N_);
        residual_ -= shift_;
        return residual_.allFinite() && N_.allFinite();
    }

    /// N^-1 of a right-hand side; the sign of det N, 0 where N is singular.
    [[nodiscard]] int solved(Column& right) noexcept
    {
        ++decompositions_;
        Eigen::Matrix<Scalar, rank, rank> N = N_;
        return detail::eliminate(N, right);
    }

    /// Of momenta F^-L(h) of the size N (h - 1), and of mu. Where N (h - 1) is so large that it hides what is left, h
    /// is none: W of 1e18 has the momenta of any. `first`: z is the guess, by whose terms that is judged.
    [[nodiscard]] bool is_rounding(const State& z, const Column& sizes, bool first) noexcept
    {
        using std::abs;
        using std::sqrt;
        const Column terms = detail::sizes_of_terms<M>(N_, sizes, z);
        if (first) visible_ = Scalar(Real(sqrt(epsilon))) * (residual_.cwiseAbs() + terms).maxCoeff();
        for (int a = 0; a < rank; ++a)
            if (!(abs(residual_[a]) <= std::min<Scalar>(Scalar(epsilon) * terms[a], visible_))) return false;
        return true;
    }

    /// Undamped steps that shrink; with `follows`, det N has the sign that it had. newton_diverged where they do not
    /// shrink.
    [[nodiscard]] Status newton(const M& model, const Scalar& t, State& z, bool follows) noexcept
    {
        Scalar before(0);
        bool negative = negative_, wide = false;
        Column first_residual, first_step;
        for (int k = 0; k < most_steps; ++k) {
            if (!evaluate(model, t, z)) return Status::non_finite;
            if (k == 1 && wide && !is_alike(first_residual, first_step)) return Status::branch_lost;
            const Column sizes = detail::sizes_along<M>(z);
            const bool found = is_rounding(z, sizes, k == 0), known = k > 0 || follows;
            if (found && known) return settle(negative);
            Column d = residual_;
            const int sign = solved(d);
            if (!known) negative = sign < 0;
            if (found) return settle(negative);
            if (sign == 0) return Status::singular_mass_matrix;
            if ((sign < 0) != negative) return Status::branch_lost;
            const Scalar length = d.cwiseAbs().maxCoeff();
            if (!(length - length == Scalar(0))) return Status::newton_diverged;
            if (k > 0 && detail::is_part<M>(d, sizes, Scalar(Real(4) * epsilon))) return settle(negative);
            const auto rounds = [&] { return length <= Scalar(Real(256) * epsilon) * detail::size_of_ends<M>(z); };
            if (k > 0 && !(length <= Scalar(Real(0.25)) * before))
                return rounds() ? settle(negative) : Status::newton_diverged;
            wide = k == 0 && !(length <= Scalar(Real(0.0625)) * detail::largest_part<M>(z)) && !rounds();
            if (wide) {
                first_residual = residual_;
                first_step = d;
                if (!keeps_sign(model, t, z, d, negative)) return Status::branch_lost;
            }
            if (!detail::move_arrow(model, t, z, d)) return Status::newton_diverged;
            moved_ += d;
            // What the next step would be, by quadratic convergence.
            if (k > 0) {
                const Scalar rate = length / before;
                if (detail::is_part<M>(Column(rate * rate * d), sizes, Scalar(Real(0.125) * epsilon)))
                    return settle(negative);
            }
            before = length;
        }
        return Status::newton_diverged;
    }

    /// True where N^-1 R of the first residual is, by the N behind the first step, that step up to half of it.
    [[nodiscard]] bool is_alike(const Column& residual, const Column& step) noexcept
    {
        Column again = residual;
        return solved(again) != 0 &&
               (again - step).cwiseAbs().maxCoeff() <= Scalar(Real(0.5)) * step.cwiseAbs().maxCoeff();
    }

    /// True where det N has the sign of the branch at points on the way along d: at its half, its quarter, and so on.
    /// Folds that all lie between two of them are not seen.
    [[nodiscard]] bool keeps_sign(const M& model, const Scalar& t, const State& z, const Column& d,
                                  bool negative) noexcept
    {
        Scalar share(1);
        for (int k = points_; k > 0; --k) {
            share *= Scalar(Real(0.5));
            State between = z;
            if (!detail::move_arrow(model, t, between, Column(share * d)) || !evaluate(model, t, between)) return false;
            Column none = residual_;
            const int sign = solved(none);
            if (sign == 0 || (sign < 0) != negative) return false;
        }
        return true;
    }

    /// The sign of det N is that of the branch from now on.
    [[nodiscard]] Status settle(bool negative) noexcept
    {
        negative_ = negative;
        return Status::ok;
    }

    /// Leads mu from F^-L of the arrow that stands in z to the one in z.
    [[nodiscard]] Status lead(const M& model, const Scalar& t, State& z, bool follows) noexcept
    {
        constexpr Real shortest = Real(1e-10), folded = Real(1e3), least = std::numeric_limits<Real>::min();
        moved_.setZero();
        if (!evaluate(model, t, z)) return Status::non_finite;
        const Column way = residual_;
        Column rate = way;
        const int sign = solved(rate);
        if (sign == 0) return Status::singular_mass_matrix;
        if (follows && (sign < 0) != negative_) return Status::branch_lost;
        negative_ = sign < 0;
        const Scalar first = rate.cwiseAbs().maxCoeff();
        Status reason = Status::ok;
        Real done(0);
        for (Real part = Real(0.25); done < Real(1);) {
            const Real to = std::min(Real(1), done + part);
            State there = z;
            shift_ = Scalar(Real(1) - to) * way;
            const Column kept = moved_;
            reason = newton(model, t, there, true);
            if (reason == Status::ok) {
                z = there;
                done = to;
                part *= Real(2);
                continue;
            }
            moved_ = kept;
            part /= Real(2);
            const bool is_short =
                part < shortest && Scalar(part) * first <= Scalar(shortest) * detail::largest_part<M>(z);
            if (is_short || part < least || !(done + part > done))
                return verdict(model, t, z, way, Scalar(Real(folded)) * first, reason);
        }
        return Status::ok;
    }

    /// Of a way that goes no further: before a fold its rate grows without bound.
    [[nodiscard]] Status verdict(const M& model, const Scalar& t, const State& z, const Column& way,
                                 const Scalar& steep, Status reason) noexcept
    {
        if (reason == Status::non_finite || !evaluate(model, t, z)) return Status::non_finite;
        Column rate = way;
        if (solved(rate) == 0) return Status::no_solution;
        return rate.cwiseAbs().maxCoeff() >= steep ? Status::no_solution : Status::newton_diverged;
    }

    Column residual_, moved_ = Column::Zero(),
                      shift_ = Column::Zero(); ///< shift_: of a way that is not at its end
    Eigen::Matrix<Scalar, rank, rank> N_;
    Scalar visible_{0};        ///< what is left of momenta may not be larger, whatever terms they have
    bool negative_ = false;    ///< the sign of det N on the branch
    int points_ = most_points; ///< on the way of a first step, where det N is looked at
    std::size_t evaluations_ = 0, decompositions_ = 0;
};

} // namespace lagen
