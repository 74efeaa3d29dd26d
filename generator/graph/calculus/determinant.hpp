// SPDX-License-Identifier: GPL-2.0-or-later
/// Determinants of matrices of graph nodes, and Cramer's rule.
#pragma once

#include "graph/core/graph.hpp"

#include <vector>

namespace lagen {

/// Larger determinants are not expanded: 2^m minors each.
inline constexpr std::size_t determinant_limit = 8;

/// The determinant of the given rows and columns, as many of each and at most `determinant_limit`, of a matrix with
/// `width` columns, by minors of growing size that share their sub-determinants.
[[nodiscard]] NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t width,
                                    const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns);
/// That of a whole matrix with `size` rows.
[[nodiscard]] NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t size);

/// A^-1 b by Cramer's rule, of a square A by rows whose determinant is `divisor`. Throws DivisionByZero where that is
/// the constant 0.
[[nodiscard]] std::vector<NodeId> solved_by_cramer(Graph& graph, const std::vector<NodeId>& A, NodeId divisor,
                                                   const std::vector<NodeId>& b);

} // namespace lagen
