// SPDX-License-Identifier: GPL-2.0-or-later
/// Dense matrices of balls: what is certain of all matrices within (Arb).
#pragma once

#include "proof/enclosure.hpp"

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

/// Whether every symmetric matrix within is positive definite; a matrix without rows is.
[[nodiscard]] bool is_certainly_definite(const BallMatrix& A, slong precision);

} // namespace lagen::proof
