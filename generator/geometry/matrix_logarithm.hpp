// SPDX-License-Identifier: GPL-2.0-or-later
/// The principal logarithm of a matrix of numbers, and how near it is to matrices that have none.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace lagen {

/// A square matrix by rows.
using RealMatrix = std::vector<long double>;

/// a b of n x n matrices.
[[nodiscard]] RealMatrix times(const RealMatrix& a, const RealMatrix& b, std::size_t n);

/// log W of an n x n matrix without eigenvalues on the negative axis, by square roots and 2 artanh((W - 1)/(W + 1));
/// nothing where they are not found.                                              [Denman, Beavers 1976; Higham 2008]
[[nodiscard]] std::optional<RealMatrix> principal_logarithm(const RealMatrix& W, std::size_t n);

/// The largest entry of Cayley's coordinates 2 (W + 1)^-1 (W - 1), infinite where W + 1 is singular: of a rotation by
/// an angle a it is 2 tan(a/2) at most.
[[nodiscard]] long double cayley_size(const RealMatrix& W, std::size_t n);

} // namespace lagen
