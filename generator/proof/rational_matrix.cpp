// SPDX-License-Identifier: GPL-2.0-or-later
/// Gaussian elimination over the rationals.
#include "proof/rational_matrix.hpp"

namespace lagen {
namespace {

/// Subtracts multiples of row `pivot` from the rows below it, so that their entries in `column` vanish.
void eliminate(std::vector<Rational>& matrix, std::size_t m, std::size_t pivot, std::size_t column)
{
    for (std::size_t row = pivot + 1; row < m; ++row) {
        const Rational factor = matrix[row * m + column] / matrix[pivot * m + column];
        for (std::size_t k = column; k < m && factor != 0; ++k) matrix[row * m + k] -= factor * matrix[pivot * m + k];
    }
}

} // namespace

std::size_t rank_of(std::vector<Rational> matrix, std::size_t m)
{
    std::size_t rank = 0;
    for (std::size_t column = 0; column < m && rank < m; ++column) {
        std::size_t pivot = rank;
        while (pivot < m && matrix[pivot * m + column] == 0) ++pivot;
        if (pivot == m) continue;
        for (std::size_t k = 0; k < m; ++k) swap(matrix[pivot * m + k], matrix[rank * m + k]);
        eliminate(matrix, m, rank, column);
        ++rank;
    }
    return rank;
}

bool is_positive_definite(std::vector<Rational> matrix, std::size_t m)
{
    for (std::size_t k = 0; k < m; ++k) {
        if (matrix[k * m + k] <= 0) return false;
        eliminate(matrix, m, k, k);
    }
    return true;
}

} // namespace lagen
