// SPDX-License-Identifier: MIT
/// The parts of an arrow of a Lie groupoid in the state of a discrete motion: where they stand, how they move along the
/// source fibre, how W is kept in its group, and what they are rounded by.
#pragma once

#include "lagen/group/retraction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lagen {

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

/// Whether h is the step of the model, up to what times of the size of t are rounded by.
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

/// Whether W is plainly no element of the group: what its coordinates around 1 lead to is another matrix. Where the
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

/// Whether a step of Newton's method is so small a part of the arrow, along each unknown.
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

} // namespace lagen
