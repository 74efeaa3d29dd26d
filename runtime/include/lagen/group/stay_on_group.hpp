// SPDX-License-Identifier: MIT
/// Matrices that a step moved along their group, but for its error, put back onto the group.
///   A = 2 (g0 + g1)^-1 (g1 - g0)      cay(A) = g0^-1 g1, with cay(A) = (1 - A/2)^-1 (1 + A/2)
///   P = the part of A in the algebra  <E_c, A>/<E_c, E_c> E_c: bases of named groups are orthogonal
///   g1 = g0 cay(P)
/// The matrix moves by no more than the error of the step, so that methods keep their order; g1 is in the group as
/// g0 is, to rounding. [Hairer, Lubich, Wanner, Geometric Numerical Integration, IV.8]
#pragma once

#include "lagen/group/retraction.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace lagen {

/// `value` in a row and a column of the generator of this number.
struct GroupEntry {
    std::size_t generator, row, column;
    double value;
};

namespace detail {

/// The part of A that the generators span.
template <class S, int n, std::size_t entries>
[[nodiscard]] GroupMatrix<S, n> part_in_algebra(const std::array<GroupEntry, entries>& generators,
                                                const GroupMatrix<S, n>& A) noexcept
{
    GroupMatrix<S, n> part;
    part.fill(S(0));
    const auto place = [](const GroupEntry& E) {
        return std::pair(static_cast<int>(E.row), static_cast<int>(E.column));
    };
    for (std::size_t begin = 0, end = 0; begin < entries; begin = end) {
        double square = 0;
        S product(0);
        for (; end < entries && generators[end].generator == generators[begin].generator; ++end) {
            const auto [row, column] = place(generators[end]);
            square += generators[end].value * generators[end].value;
            product += S(generators[end].value) * A(row, column);
        }
        for (std::size_t k = begin; k < end; ++k) {
            const auto [row, column] = place(generators[k]);
            part(row, column) += S(generators[k].value / square) * product;
        }
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
    const auto lane = [&](int i, int j) { return first + static_cast<Eigen::Index>(i * n + j); };
    GroupMatrix<S, n> sum, difference, A, step;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            sum(i, j) = s0[lane(i, j)] + s1[lane(i, j)];
            difference(i, j) = S(2) * (s1[lane(i, j)] - s0[lane(i, j)]);
        }
    auto holds = detail::solve_matrix<S, n>(sum, difference, A);
    holds = holds & cayley_less_one<S, n>(detail::part_in_algebra<S, n>(generators, A), step);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            S moved(0);
            for (int k = 0; k < n; ++k) moved += s0[lane(i, k)] * step(k, j);
            S& entry = s1[lane(i, j)];
            entry = select(holds, S(s0[lane(i, j)] + moved), entry);
        }
}

} // namespace lagen
