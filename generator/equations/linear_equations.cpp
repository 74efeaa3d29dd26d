// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/linear_equations.hpp"

#include <algorithm>
#include <numeric>

namespace lagen {
namespace {

using Block = std::vector<std::size_t>;
using Simpler = std::function<GiNaC::ex(const GiNaC::ex&)>;

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

/// Along the first row.
GiNaC::ex determinant(const SquareMatrix& matrix)
{
    if (matrix.order == 0) return 1;
    GiNaC::ex sum = 0;
    for (std::size_t column = 0; column < matrix.order; ++column) {
        if (matrix(0, column).is_zero()) continue;
        SquareMatrix minor{matrix.order - 1, {}};
        for (std::size_t i = 1; i < matrix.order; ++i)
            for (std::size_t j = 0; j < matrix.order; ++j)
                if (j != column) minor.entries.push_back(matrix(i, j));
        const GiNaC::ex term = matrix(0, column) * determinant(minor);
        sum += column % 2 == 0 ? term : GiNaC::ex(-term);
    }
    return sum;
}

/// Cramer's rule: det(A with b for column k) / det A.
std::optional<GiNaC::exvector> solve_by_determinants(const SquareMatrix& A, const GiNaC::exvector& b,
                                                     const Simpler& simpler)
{
    const GiNaC::ex whole = simpler(determinant(A));
    if (whole.is_zero()) return {};
    GiNaC::exvector z;
    for (std::size_t k = 0; k < A.order; ++k) {
        SquareMatrix replaced = A;
        for (std::size_t i = 0; i < A.order; ++i) replaced.entries[i * A.order + k] = b[i];
        z.push_back(simpler(determinant(replaced)) / whole);
    }
    return z;
}

/// Rows [A | b] of numbers A, reduced; false where A is singular.
std::optional<GiNaC::exvector> solve_by_elimination(SquareMatrix A, GiNaC::exvector b)
{
    for (std::size_t k = 0; k < A.order; ++k) {
        std::size_t pivot = k;
        while (pivot < A.order && A(pivot, k).is_zero()) ++pivot;
        if (pivot == A.order) return {};
        std::swap(b[k], b[pivot]);
        for (std::size_t j = 0; j < A.order; ++j) std::swap(A.entries[k * A.order + j], A.entries[pivot * A.order + j]);
        for (std::size_t i = 0; i < A.order; ++i) {
            if (i == k || A(i, k).is_zero()) continue;
            const GiNaC::ex factor = A(i, k) / A(k, k);
            for (std::size_t j = k; j < A.order; ++j) A.entries[i * A.order + j] -= factor * A(k, j);
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = 0; k < A.order; ++k) b[k] /= A(k, k);
    return b;
}

} // namespace

std::vector<Block> coupled_unknowns(const SquareMatrix& matrix)
{
    const std::size_t n = matrix.order;
    Block root(n); // the first unknown of each one's class
    std::iota(root.begin(), root.end(), std::size_t{0});
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            if (matrix(i, j).is_zero() || root[i] == root[j]) continue;
            const auto [first, second] = std::minmax({root[i], root[j]});
            std::replace(root.begin(), root.end(), second, first);
        }
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < n; ++i)
        if (root[i] == i) {
            Block block;
            for (std::size_t j = i; j < n; ++j)
                if (root[j] == i) block.push_back(j);
            blocks.push_back(std::move(block));
        }
    return blocks;
}

std::optional<GiNaC::exvector> solve_in_blocks(const SquareMatrix& A, const GiNaC::exvector& b, const Simpler& simpler)
{
    GiNaC::exvector z(A.order);
    for (const Block& block : coupled_unknowns(A)) {
        const SquareMatrix part = part_of(A, block);
        GiNaC::exvector right;
        for (const std::size_t i : block) right.push_back(b[i]);
        const bool small = block.size() <= largest_written_block;
        if (!small && !all_numbers(part)) return {};
        const auto solution = small ? solve_by_determinants(part, right, simpler) : solve_by_elimination(part, right);
        if (!solution) return {};
        for (std::size_t k = 0; k < block.size(); ++k) z[block[k]] = (*solution)[k];
    }
    return z;
}

} // namespace lagen
