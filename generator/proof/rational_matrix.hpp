// SPDX-License-Identifier: GPL-2.0-or-later
/// Rank and definiteness of a square matrix of exact numbers, by elimination.
#pragma once

#include "expression/tree.hpp"

namespace lagen {

/// Rank over the rationals. `matrix` has m rows of m entries.
[[nodiscard]] std::size_t rank_of(std::vector<Rational> matrix, std::size_t m);

/// Of a symmetric matrix: all pivots of the elimination without exchanges are positive (Sylvester's criterion).
[[nodiscard]] bool is_positive_definite(std::vector<Rational> matrix, std::size_t m);

} // namespace lagen
