// SPDX-License-Identifier: MIT
/// A X = B for the few unknowns of a step on a group, in place: Gauss's elimination with rows exchanged, where pivots
/// are compared relative to the largest entry of their row. PivotedLu (linear.hpp) is for matrices that are looked at
/// again, and for packs.
#pragma once

#include "lagen/linear.hpp"

#include <cmath>

namespace lagen::detail {

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
