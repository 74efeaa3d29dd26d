// SPDX-License-Identifier: MIT
/// Maps between a matrix group and its Lie algebra near the unit, on W - 1 in the place of W, so that nothing is lost
/// of an element that is close to it. Matrices are N x N columns of Eigen; nothing allocates.
///   Cayley     W = (1 - A/2)^-1 (1 + A/2),  W - 1 = (1 - A/2)^-1 A,  A = 2 (W - 1) (W + 1)^-1
///   exp        W - 1 = A + A^2/2 + .., by halving A and squaring W
/// Cayley's map leads into the quadratic groups (SO, SE, Sp and their like), exp into every one. [Iserles et al. 2000]
#pragma once

#include "lagen/group/eliminate.hpp"

#include <cmath>

namespace lagen {

template <class S, int N>
using GroupMatrix = Eigen::Matrix<S, N, N>;

namespace detail {

/// A^-1 B; false where A is singular, and X is left as it is then.
template <class S, int N>
[[nodiscard]] bool solve_matrix(GroupMatrix<S, N> A, GroupMatrix<S, N> B, GroupMatrix<S, N>& X) noexcept
{
    if (eliminate(A, B) == 0) return false;
    X = B;
    return true;
}

} // namespace detail

/// W - 1 = (1 - A/2)^-1 A into V; false where 1 - A/2 is singular.
template <class S, int N>
[[nodiscard]] bool cayley_less_one(const GroupMatrix<S, N>& A, GroupMatrix<S, N>& V) noexcept
{
    return detail::solve_matrix<S, N>(GroupMatrix<S, N>::Identity() - A / S(2), A, V);
}

/// A with (1 - A/2)^-1 (1 + A/2) = 1 + V; false where 2 + V is singular (a rotation by pi).
template <class S, int N>
[[nodiscard]] bool cayley_inverse(const GroupMatrix<S, N>& V, GroupMatrix<S, N>& A) noexcept
{
    return detail::solve_matrix<S, N>(GroupMatrix<S, N>::Identity() + V / S(2), V, A);
}

/// exp(A) - 1.
template <class S, int N>
[[nodiscard]] GroupMatrix<S, N> exp_less_one(GroupMatrix<S, N> A) noexcept
{
    using std::abs;
    using std::isfinite;
    constexpr int most_halvings = 64, most_terms = 60;
    S size(0);
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) size += abs(A(i, j));
    int halvings = 0;
    for (; size > S(0.5) && halvings < most_halvings; ++halvings) size /= S(2), A /= S(2);
    GroupMatrix<S, N> V = A, term = A;
    for (int k = 2; k <= most_terms; ++k) {
        term = GroupMatrix<S, N>(term * A) / S(k);
        const GroupMatrix<S, N> sum = V + term;
        if (sum == V) break;
        V = sum;
    }
    for (; halvings > 0; --halvings) V = GroupMatrix<S, N>(S(2) * V + V * V);
    return V;
}

/// A with exp(A) = 1 + V, the one that Cayley's map is close to; false where none is found.
template <class S, int N>
[[nodiscard]] bool log_of_one_and(const GroupMatrix<S, N>& V, GroupMatrix<S, N>& A) noexcept
{
    using std::abs;
    constexpr int most_corrections = 60;
    if (!cayley_inverse<S, N>(V, A)) return false;
    const S small = S(4) * S(std::numeric_limits<real_t<S>>::epsilon());
    for (int k = 0; k < most_corrections; ++k) {
        // exp(-A) (1 + V) - 1, all of them functions of V that commute
        const GroupMatrix<S, N> back = exp_less_one<S, N>(-A);
        const GroupMatrix<S, N> rest = back + V + back * V;
        GroupMatrix<S, N> correction;
        if (!cayley_inverse<S, N>(rest, correction)) return false;
        A += correction;
        if (!(correction.cwiseAbs().maxCoeff() > small * A.cwiseAbs().maxCoeff())) return A.allFinite();
    }
    return false;
}

} // namespace lagen
