// SPDX-License-Identifier: GPL-2.0-or-later
/// A minor of a square matrix that need not be symmetric, guessed by numbers at a point; its determinant tells whether
/// the guess was right.
#pragma once

#include "graph/core/graph.hpp"

#include <optional>

namespace lagen {

/// Rows and columns of a minor, in the order of their pivots.
struct PivotedMinor {
    std::vector<std::size_t> rows, columns;
};

/// Elimination at one point with the largest pivot of the rows from `first` on, then of those before; rounding decides
/// which pivots are zero, and is not believed.
[[nodiscard]] std::optional<PivotedMinor> guess_minor(std::vector<long double> N, std::size_t m, std::size_t first);

/// The determinant as a product of pivots in their order, for matrices of any size: short, and defined where no pivot
/// vanishes.
[[nodiscard]] NodeId product_of_pivots(Graph& graph, std::vector<NodeId> N, std::size_t m, const PivotedMinor& minor);

} // namespace lagen
