// SPDX-License-Identifier: GPL-2.0-or-later
/// Determinants of matrices of graph nodes, and Cramer's rule.
#pragma once

#include "graph/calculus/places.hpp"
#include "graph/core/graph.hpp"

namespace lagen {

/// Larger determinants are not expanded: 2^m minors each.
inline constexpr std::size_t determinant_limit = 8;

/// The determinant of the given rows and columns, as many of each and at most `determinant_limit`, of a matrix with
/// `width` columns, by minors of growing size that share their sub-determinants.
[[nodiscard]] NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t width,
                                    const Places& rows, const Places& columns);
/// That of a whole matrix with `size` rows.
[[nodiscard]] NodeId determinant_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t size);

/// z with A z = b by Cramer's rule, of the square part A of a matrix with these rows and columns.
struct CramersRule {
    Graph& graph;
    const std::vector<NodeId>& matrix;
    std::size_t width;
    Places rows, columns;
    std::vector<NodeId> b; ///< one a row
    NodeId divisor = determinant_of(graph, matrix, width, rows, columns);

    /// divisor * z^k
    [[nodiscard]] NodeId numerator(std::size_t k) const;
    /// z^k; throws DivisionByZero where the divisor is the constant 0 and the numerator is not.
    [[nodiscard]] NodeId operator()(std::size_t k) const { return graph.divide(numerator(k), divisor); }
    /// All of them.
    [[nodiscard]] std::vector<NodeId> solution() const;
};

} // namespace lagen
