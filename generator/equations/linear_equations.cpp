// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/linear_equations.hpp"

#include "symbolic/ginac_ring.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Block = std::vector<std::size_t>;

SquareMatrix part_of(const SquareMatrix& matrix, const Block& block)
{
    SquareMatrix part{block.size(), {}};
    for (const std::size_t i : block)
        for (const std::size_t j : block) part.entries.push_back(matrix(i, j));
    return part;
}

bool all_numbers(const SquareMatrix& matrix)
{
    return std::all_of(matrix.entries.begin(), matrix.entries.end(),
                       [](const GiNaC::ex& entry) { return GiNaC::is_a<GiNaC::numeric>(entry); });
}

/// Cramer's rule: det(A with b for column k) / det A.
std::optional<GiNaC::exvector> solve_by_determinants(const SquareMatrix& A, const GiNaC::exvector& b,
                                                     const Rewriting& simpler, const Rewriting& divisor)
{
    const GinacRing ring{A.entries, A.order};
    GiNaC::ex whole = simpler(determinant(ring, A.order));
    if (whole.is_zero()) return {};
    if (divisor) whole = divisor(whole);
    GiNaC::exvector z;
    for (std::size_t k = 0; k < A.order; ++k) z.push_back(simpler(numerator(ring, k, b)) / whole);
    return z;
}

/// The matrix A is one of numbers; nothing comes where A is singular.
std::optional<GiNaC::exvector> solve_by_elimination(const SquareMatrix& A, const GiNaC::exvector& b)
{
    const Factorisation<GiNaC::ex> factors = factorise(A.entries, A.order);
    if (!factors.regular) return {};
    return substitute(factors, b);
}

} // namespace

std::vector<Block> coupled_unknowns(const SquareMatrix& matrix)
{
    return connected_classes(matrix.order, [&](std::size_t i, std::size_t j) { return !matrix(i, j).is_zero(); });
}

std::optional<GiNaC::exvector> solve_in_blocks(const SquareMatrix& A, const GiNaC::exvector& b,
                                               const Rewriting& simpler, const Rewriting& divisor)
{
    GiNaC::exvector z(A.order);
    for (const Block& block : coupled_unknowns(A)) {
        const SquareMatrix part = part_of(A, block);
        GiNaC::exvector right;
        for (const std::size_t i : block) right.push_back(b[i]);
        const bool small = block.size() <= largest_written_block;
        if (!small && !all_numbers(part)) return {};
        const auto solution =
            small ? solve_by_determinants(part, right, simpler, divisor) : solve_by_elimination(part, right);
        if (!solution) return {};
        for (std::size_t k = 0; k < block.size(); ++k) z[block[k]] = (*solution)[k];
    }
    return z;
}

} // namespace lagen
