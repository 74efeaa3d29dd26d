// SPDX-License-Identifier: GPL-2.0-or-later
/// Factorisations and solutions as statements: 2 x 2 in closed form, L D L^T up to order 16 where definiteness is
/// proved (zero pattern respected, order of elimination chosen for least fill), pivoted LU from the runtime otherwise.
/// Cofactors are never used beyond order 2: they lose all digits at condition numbers where elimination keeps them.
#pragma once

#include "emit/node_expressions.hpp"

#include <functional>

namespace lagen {

/// Nothing stands for zero.
using Term = std::optional<Expression>;

/// One factorisation as it stands in a function body: by what solutions find its parts.
struct UnrolledFactor {
    enum class Kind { closed_form, ldlt, pivoted } kind = Kind::pivoted;
    std::size_t order = 0;
    std::vector<std::size_t> elimination; ///< ldlt: position -> row of the matrix
    std::vector<Term> entries;            ///< closed form: the four entries
    Expression whole;                     ///< closed form: 1 / determinant; pivoted: the PivotedLu
    std::vector<std::vector<Term>> l;     ///< ldlt: l[i][j], j < i
    std::vector<Expression> reciprocals;  ///< ldlt: 1 / d_j
};

/// Where statements go and how new names are made.
struct SolveContext {
    const Graph& graph;
    const NodeExpressions& expressions;
    std::function<void(Statement)> add;
    std::function<std::string(const std::string&)> fresh; ///< a name that nobody uses, from a wish
};

/// The statements of the factorisation `id`. With `check` it fails where the matrix is singular; `solved` is false
/// where only the check is wanted.
[[nodiscard]] UnrolledFactor unroll_factor(const SolveContext& context, NodeId id, std::size_t number, bool check,
                                           bool solved);

/// The statements of the solution `id` by a factorisation; answers its components. Those that `wanted` does not ask for
/// may be zero.
[[nodiscard]] std::vector<Expression> unroll_solution(const SolveContext& context, const UnrolledFactor& factor,
                                                      NodeId id, std::size_t number, const std::vector<bool>& wanted);

/// The order of elimination of a symmetric matrix by least degree; ties go to the smaller row.
[[nodiscard]] std::vector<std::size_t> least_degree_order(std::vector<std::vector<bool>> pattern);

} // namespace lagen
