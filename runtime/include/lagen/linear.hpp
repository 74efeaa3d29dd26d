// SPDX-License-Identifier: MIT
/// Small dense linear systems for generated kernels: LU with scaled row pivoting. No allocation, no exceptions, any
/// scalar; on SIMD packs every lane pivots on its own, by selection instead of branches.
/// Used where definiteness is not known, or beyond the size that is written out.
#pragma once

#include "lagen/kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lagen {

/// 2 n epsilon: a pivot of an n x n elimination that is smaller than this multiple of the terms it is the sum of
/// consists of rounding errors only, so the matrix cannot be told from a singular one.
template <class S>
[[nodiscard]] S singular_tolerance(int n) noexcept
{
    return S(2 * n) * S(std::numeric_limits<real_t<S>>::epsilon());
}

/// P A = L U of an N x N matrix. The pivot of column k is the entry that is largest relative to its row, of those that
/// are more than rounding errors of the terms they were computed from; where there is none, the matrix counts as
/// singular. Scaling rows or columns (units: diag(1e-12, 1e12) is regular) does not change that decision, because the
/// terms scale with the entry. Of random matrices that are singular but for the rounding of their entries it recognises
/// 97 in 100 (orders 3 to 8); the others give accelerations of about 1/epsilon.
template <class S, int N>
class PivotedLu {
  public:
    using Mask = typename StatusOf<S>::mask;
    static constexpr std::size_t size = static_cast<std::size_t>(N);

    /// Factorises `matrix`, N*N entries by rows. Answers where it is numerically singular (a mask a lane).
    [[nodiscard]] Mask factor(const std::array<S, size * size>& matrix) noexcept
    {
        using std::abs;
        lu_ = matrix;
        scale();
        Mask singular = S(1) < S(0);
        for (std::size_t k = 0; k < size; ++k) {
            singular = singular | (bring_up_pivot(k) <= S(0));
            const S reciprocal = S(1) / at(k, k);
            reciprocals_[k] = reciprocal;
            for (std::size_t i = k + 1; i < size; ++i) {
                const S multiplier = at(i, k) * reciprocal;
                at(i, k) = multiplier;
                for (std::size_t j = k + 1; j < size; ++j) {
                    const S term = multiplier * at(k, j);
                    at(i, j) -= term;
                    terms_[i * size + j] += abs(term);
                }
            }
        }
        return singular;
    }

    /// x with A x = b; the entries of b may be several right-hand sides each (lagen/lanes/columns.hpp).
    template <class Entry = S>
    [[nodiscard]] std::array<Entry, size> solve(std::array<Entry, size> b) const noexcept
    {
        for (std::size_t k = 0; k < size; ++k) // the exchanges, in the order in which they were made
            for (std::size_t i = k + 1; i < size; ++i) exchange(swaps_[k * size + i], b[k], b[i]);
        for (std::size_t i = 1; i < size; ++i)
            for (std::size_t j = 0; j < i; ++j) b[i] -= at(i, j) * b[j];
        for (std::size_t i = size; i-- > 0;) {
            for (std::size_t j = i + 1; j < size; ++j) b[i] -= at(i, j) * b[j];
            b[i] *= reciprocals_[i];
        }
        return b;
    }

  private:
    [[nodiscard]] S& at(std::size_t i, std::size_t j) noexcept { return lu_[i * size + j]; }
    [[nodiscard]] const S& at(std::size_t i, std::size_t j) const noexcept { return lu_[i * size + j]; }

    template <class Entry>
    static void exchange(Mask where, Entry& a, Entry& b) noexcept
    {
        if constexpr (std::is_same_v<Mask, bool>) {
            if (!where) return;
            const Entry kept = a;
            a = b;
            b = kept;
        } else {
            const S kept = a;
            a = select(where, b, a);
            b = select(where, kept, b);
        }
    }

    /// 1 / max |a_ij| by rows; 1 for a row of zeros. The sums of terms begin as the entries themselves.
    void scale() noexcept
    {
        using std::abs;
        for (std::size_t i = 0; i < size; ++i) {
            S largest(0);
            for (std::size_t j = 0; j < size; ++j) {
                const S value = abs(at(i, j));
                terms_[i * size + j] = value;
                largest = select(value > largest, value, largest);
            }
            row_scale_[i] = S(1) / select(largest > S(0), largest, S(1));
        }
    }

    /// |a_ik| relative to its row; 0 where it is a rounding error of its terms.
    [[nodiscard]] S weight(std::size_t i, std::size_t k) const noexcept
    {
        using std::abs;
        const S value = abs(at(i, k));
        const S relative = value * row_scale_[i];
        return select(value <= singular_tolerance<S>(N) * terms_[i * size + k], S(0), relative);
    }

    /// Exchanges rows until row k holds the entry of column k with the largest weight; answers that weight.
    S bring_up_pivot(std::size_t k) noexcept
    {
        S largest = weight(k, k);
        for (std::size_t i = k + 1; i < size; ++i) {
            const S value = weight(i, k);
            const Mask larger = value > largest;
            swaps_[k * size + i] = larger;
            largest = select(larger, value, largest);
            exchange(larger, row_scale_[k], row_scale_[i]);
            for (std::size_t j = 0; j < size; ++j) {
                exchange(larger, at(k, j), at(i, j));
                exchange(larger, terms_[k * size + j], terms_[i * size + j]);
            }
        }
        return largest;
    }

    std::array<S, size * size> lu_{};
    std::array<Mask, size * size> swaps_{};
    std::array<S, size> reciprocals_{};
    std::array<S, size> row_scale_{};
    std::array<S, size * size> terms_{}; ///< sums of the sizes of what every entry was computed from
};

} // namespace lagen
