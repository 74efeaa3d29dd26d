// SPDX-License-Identifier: MIT
/// Matrices that a step moved along their group, but for its error, put back onto the group.
///   A = 2 (g0 + g1)^-1 (g1 - g0)      cay(A) = g0^-1 g1, with cay(A) = (1 - A/2)^-1 (1 + A/2)
///   P = the part of A in the algebra  <E_c, A>/<E_c, E_c> E_c: bases of named groups are orthogonal
///   g1 = g0 cay(P)
/// The matrix moves by no more than the error of the step, so that methods keep their order; g1 is in the group as
/// g0 is, to rounding. [Hairer, Lubich, Wanner, Geometric Numerical Integration, IV.8]
#pragma once

#include "lagen/linear.hpp"

#include <array>
#include <cstddef>

namespace lagen {

/// `value` in a row and a column of the generator of this number.
struct GroupEntry {
    std::size_t generator, row, column;
    double value;
};

namespace detail {

/// The part of A, size x size by rows, that the generators span.
template <class S, std::size_t size2, std::size_t entries>
[[nodiscard]] std::array<S, size2> part_in_algebra(const std::array<GroupEntry, entries>& generators,
                                                   const std::array<S, size2>& A, std::size_t size) noexcept
{
    std::array<S, size2> part;
    part.fill(S(0));
    for (std::size_t begin = 0, end = 0; begin < entries; begin = end) {
        double square = 0;
        S product(0);
        for (; end < entries && generators[end].generator == generators[begin].generator; ++end) {
            const GroupEntry& E = generators[end];
            square += E.value * E.value;
            product += S(E.value) * A[E.row * size + E.column];
        }
        for (std::size_t k = begin; k < end; ++k)
            part[generators[k].row * size + generators[k].column] += S(generators[k].value / square) * product;
    }
    return part;
}

} // namespace detail

/// Of matrices n x n by rows, the lanes from `first` on of s0 and s1. s1 is left where g0 and g1 are as far from each
/// other as they can be (a turn by pi), or it is not finite.
template <int n, std::size_t entries, class State>
void stay_on_group(const std::array<GroupEntry, entries>& generators, const State& s0, State& s1,
                   Eigen::Index first) noexcept
{
    using S = typename State::Scalar;
    constexpr auto size = static_cast<std::size_t>(n);
    const auto lane = [&](std::size_t i, std::size_t j) { return first + static_cast<Eigen::Index>(i * size + j); };
    std::array<S, size * size> sum, A, left;
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j) sum[i * size + j] = s0[lane(i, j)] + s1[lane(i, j)];
    PivotedLu<S, n> lu;
    auto fails = lu.factor(sum);
    for (std::size_t j = 0; j < size; ++j) {
        std::array<S, size> column;
        for (std::size_t i = 0; i < size; ++i) column[i] = S(2) * (s1[lane(i, j)] - s0[lane(i, j)]);
        column = lu.solve(column);
        for (std::size_t i = 0; i < size; ++i) A[i * size + j] = column[i];
    }
    const std::array<S, size* size> P = detail::part_in_algebra(generators, A, size);
    for (std::size_t k = 0; k < size * size; ++k) left[k] = S(k % (size + 1) == 0 ? 1 : 0) - S(0.5) * P[k];
    fails = fails | lu.factor(left);
    for (std::size_t j = 0; j < size; ++j) { // cay(P) - 1 = (1 - P/2)^-1 P
        std::array<S, size> column;
        for (std::size_t i = 0; i < size; ++i) column[i] = P[i * size + j];
        column = lu.solve(column);
        for (std::size_t i = 0; i < size; ++i) A[i * size + j] = column[i];
    }
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j) {
            S step(0);
            for (std::size_t k = 0; k < size; ++k) step += s0[lane(i, k)] * A[k * size + j];
            S& entry = s1[lane(i, j)];
            entry = select(fails, entry, S(s0[lane(i, j)] + step));
        }
}

} // namespace lagen
