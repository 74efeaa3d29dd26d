// SPDX-License-Identifier: GPL-2.0-or-later
/// Relations that every matrix W of the connected group G obeys which matrices E_a generate:
///   W - 1 lies in the associative algebra of the E_a (without 1), since exp(A) - 1 does;
///   W^T J W = J wherever E_a^T J + J E_a = 0 for all a;    W K W^T = K wherever E_a K + K E_a^T = 0 for all a;
///   det W = 1 where tr E_a = 0 for all a, else det W != 0.
/// Of the groups with a name (SO, SE, SU, SL, HEIS, AFF, GL, R^n and their sums) they leave nothing else near 1.
#pragma once

#include "geometry/matrix_logarithm.hpp"

#include <string>

namespace lagen {

/// The relation that W misses most, and by how much of its own size.
struct GroupDefect {
    std::string relation; ///< "transpose(W)*W = 1"
    long double size = 0;
};

/// Of W and generators of n x n numbers. For n > 12 it is J = K = 1 and the determinant alone.
[[nodiscard]] GroupDefect group_defect(const std::vector<RealMatrix>& generators, const RealMatrix& W, std::size_t n);

/// How far log W is from the span of the generators, relative to its size: what generators without a name leave
/// besides, as a line on a torus. 0 where W has no principal logarithm. The way to an element may be longer than its
/// logarithm, whose sheet is another one then.
[[nodiscard]] GroupDefect logarithm_defect(const std::vector<RealMatrix>& generators, const RealMatrix& W,
                                           std::size_t n);

} // namespace lagen
