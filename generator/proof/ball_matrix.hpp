// SPDX-License-Identifier: GPL-2.0-or-later
/// Dense matrices of balls: what is certain of all matrices within (Arb).
#pragma once

#include "proof/enclosure.hpp"

#include <functional>
#include <vector>

namespace lagen::proof {

/// Entries by rows.
struct BallMatrix {
    std::size_t rows = 0, columns = 0;
    std::vector<Ball> entries;

    BallMatrix(std::size_t m, std::size_t n) : rows(m), columns(n), entries(m * n) {}
    [[nodiscard]] Ball& at(std::size_t i, std::size_t j) { return entries[i * columns + j]; }
    [[nodiscard]] const Ball& at(std::size_t i, std::size_t j) const { return entries[i * columns + j]; }
    [[nodiscard]] static BallMatrix identity(std::size_t n);
};

[[nodiscard]] BallMatrix product(const BallMatrix& A, const BallMatrix& B, slong precision);
/// A + factor B
[[nodiscard]] BallMatrix sum(const BallMatrix& A, const Ball& factor, const BallMatrix& B, slong precision);
/// Columns of `rows` entries side by side.
[[nodiscard]] BallMatrix joined_columns(const std::vector<BallMatrix>& columns, std::size_t rows);
[[nodiscard]] BallMatrix transposed(const BallMatrix& A);

/// X with A X = B for all of them, A square; nothing where A is not certainly invertible.
[[nodiscard]] std::optional<BallMatrix> solved(const BallMatrix& A, const BallMatrix& B, slong precision);

/// True where every symmetric matrix within is positive definite; a matrix without rows is.
[[nodiscard]] bool is_certainly_definite(const BallMatrix& A, slong precision);

// Newton's method in balls for as many equations F(z) = 0 as unknowns, with its certificate: where
//   u - (dF/dz)(box)^-1 F(u)
// lies inside the box around u, the box holds one root, and that lies in there. [Moore 1966]

/// F, m x 1, and dF/dz, m x m, for all z in some balls.
struct NewtonEquations {
    BallMatrix value, slope;
};

struct RefinedRoot {
    std::vector<Ball> z;    ///< `start` where Newton's method does not converge to a root near it
    bool certified = false; ///< a root lies in these balls
};

/// Newton steps from `start` at `bits`, then one of intervals in boxes that grow from 2^-160 to 2^-40. The first
/// `watched` unknowns may not move by more than 1e-3 of themselves: that is another root.
[[nodiscard]] RefinedRoot refined_root(const std::function<NewtonEquations(const std::vector<Ball>&)>& equations,
                                       const std::vector<Ball>& start, std::size_t watched, slong bits);

/// The same ball with a radius of 2^-`exponent`.
[[nodiscard]] Ball widened(const Ball& ball, long exponent);
/// The radius, rounded up.
[[nodiscard]] double radius_of(const Ball& ball);

} // namespace lagen::proof
