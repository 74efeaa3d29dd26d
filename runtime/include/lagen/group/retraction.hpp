// SPDX-License-Identifier: MIT
/// Maps between a matrix group and its Lie algebra near the unit, on W - 1 in the place of W, so that nothing is lost
/// of an element that is close to it. Matrices are N x N columns of Eigen; nothing allocates.
///   Cayley     W = (1 - A/2)^-1 (1 + A/2),  W - 1 = (1 - A/2)^-1 A,  A = 2 (W - 1) (W + 1)^-1
///   exp        W - 1 = A + A^2/2 + .., by halving A and squaring W
/// Cayley's map leads into the quadratic groups (SO, SE, Sp and their like), exp into every one. [Iserles et al. 2000]
#pragma once

#include "lagen/linear.hpp"

#include <cmath>

namespace lagen {

template <class S, int N>
using GroupMatrix = Eigen::Matrix<S, N, N>;

namespace detail {

/// A^-1 B, a lane where packs are the entries; answers where A is regular.
template <class S, int N>
[[nodiscard]] typename StatusOf<S>::mask solve_matrix(const GroupMatrix<S, N>& A, const GroupMatrix<S, N>& B,
                                                      GroupMatrix<S, N>& X) noexcept
{
    constexpr auto size = static_cast<std::size_t>(N);
    std::array<S, size * size> entries;
    for (std::size_t k = 0; k < entries.size(); ++k)
        entries[k] = A(static_cast<int>(k / size), static_cast<int>(k % size));
    PivotedLu<S, N> lu;
    const auto singular = lu.factor(entries);
    for (int j = 0; j < N; ++j) {
        std::array<S, size> column;
        for (int i = 0; i < N; ++i) column[static_cast<std::size_t>(i)] = B(i, j);
        column = lu.solve(column);
        for (int i = 0; i < N; ++i) X(i, j) = column[static_cast<std::size_t>(i)];
    }
    return !singular;
}

} // namespace detail

/// W - 1 = (1 - A/2)^-1 A into V; answers where 1 - A/2 is regular.
template <class S, int N>
[[nodiscard]] typename StatusOf<S>::mask cayley_less_one(const GroupMatrix<S, N>& A, GroupMatrix<S, N>& V) noexcept
{
    GroupMatrix<S, N> left;
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) left(i, j) = S(i == j ? 1 : 0) - S(0.5) * A(i, j);
    return detail::solve_matrix<S, N>(left, A, V);
}

/// A with (1 - A/2)^-1 (1 + A/2) = 1 + V; answers where 2 + V is regular (a rotation by pi is not).
template <class S, int N>
[[nodiscard]] typename StatusOf<S>::mask cayley_inverse(const GroupMatrix<S, N>& V, GroupMatrix<S, N>& A) noexcept
{
    GroupMatrix<S, N> left;
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) left(i, j) = S(i == j ? 1 : 0) + S(0.5) * V(i, j);
    return detail::solve_matrix<S, N>(left, V, A);
}

/// exp(A) - 1.
template <class S, int N>
[[nodiscard]] GroupMatrix<S, N> exp_less_one(GroupMatrix<S, N> A) noexcept
{
    using std::abs;
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
