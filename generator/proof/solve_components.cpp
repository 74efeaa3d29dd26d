// SPDX-License-Identifier: GPL-2.0-or-later
/// Components of z = A^-1 b in the ring: Cramer's rule where A is small.
#include "expression/linear_algebra.hpp"
#include "proof/normal_form.hpp"

namespace lagen::proof {

namespace {

constexpr std::size_t largest_determinant = 4; ///< rows; beyond, see linear_systems.cpp

/// A matrix of fractions.
struct FractionRing {
    using Number = Fraction;
    Ring& ring;
    const std::vector<Fraction>& matrix;
    std::size_t n;

    [[nodiscard]] Fraction zero() const { return {}; }
    [[nodiscard]] Fraction one() const { return ring.constant(1); }
    [[nodiscard]] const Fraction& entry(std::size_t i, std::size_t j) const { return matrix[i * n + j]; }
    [[nodiscard]] bool is_zero(const Fraction& a) const { return a.is_zero(); }
    [[nodiscard]] Fraction times(const Fraction& a, const Fraction& b) const { return ring.times(a, b); }
    void add(Fraction& sum, const Fraction& term, int sign) const { sum = ring.add(sum, term, sign); }
};

} // namespace

Fraction NormalForm::component(NodeId node)
{
    const NodeId solve = graph_.operands(node)[0];
    const auto operands = graph_.operands(solve);
    const std::size_t n = operands.size() - 1, row = graph_.payload(node);
    if (n > largest_determinant) return solution(solve)[row];
    std::vector<Fraction> matrix, right;
    for (const NodeId entry : graph_.operands(operands[0])) matrix.push_back(done_.at(entry));
    for (std::size_t k = 0; k < n; ++k) right.push_back(done_.at(operands[k + 1]));
    const Fraction whole = determinant(FractionRing{ring_, matrix, n}, n);
    return ring_.divide(numerator(FractionRing{ring_, matrix, n}, row, right), whole);
}

} // namespace lagen::proof
