// SPDX-License-Identifier: GPL-2.0-or-later
/// Components of z = A^-1 b in the ring: Cramer's rule where A is small.
#include "proof/normal_form.hpp"

namespace lagen::proof {

namespace {

constexpr std::size_t largest_determinant = 4; ///< rows; beyond, see linear_systems.cpp

} // namespace

Fraction NormalForm::determinant(const std::vector<Fraction>& matrix, std::size_t n)
{
    if (n == 1) return matrix[0];
    Fraction sum;
    for (std::size_t column = 0; column < n; ++column) {
        if (matrix[column].is_zero()) continue;
        std::vector<Fraction> minor;
        for (std::size_t i = 1; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                if (j != column) minor.push_back(matrix[i * n + j]);
        const Fraction product = ring_.times(matrix[column], determinant(minor, n - 1));
        sum = ring_.add(sum, product, column % 2 == 0 ? 1 : -1);
    }
    return sum;
}

Fraction NormalForm::component(NodeId node)
{
    const NodeId solve = graph_.operands(node)[0];
    const auto operands = graph_.operands(solve);
    const std::size_t n = operands.size() - 1, row = graph_.payload(node);
    if (n > largest_determinant) return solution(solve)[row];
    std::vector<Fraction> matrix, right;
    for (const NodeId entry : graph_.operands(operands[0])) matrix.push_back(done_.at(entry));
    for (std::size_t k = 0; k < n; ++k) right.push_back(done_.at(operands[k + 1]));
    const Fraction whole = determinant(matrix, n);
    for (std::size_t i = 0; i < n; ++i) matrix[i * n + row] = right[i];
    return ring_.divide(determinant(matrix, n), whole);
}

} // namespace lagen::proof
