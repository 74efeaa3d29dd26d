// SPDX-License-Identifier: GPL-2.0-or-later
/// Determinants of matrices of graph nodes.
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

} // namespace lagen
