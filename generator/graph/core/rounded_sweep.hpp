// SPDX-License-Identifier: GPL-2.0-or-later
/// The interpreter once more, with every operation rounded to a significand of 24 bits in the range of double, so that
/// rounding errors stand far above those of double.
#pragma once

#include "graph/core/graph.hpp"

#include <vector>

namespace lagen {

/// Values of all `nodes` (ascending, complete), by id; inputs in the order of graph.inputs(). `rounded`: 24 bits, else
/// double. A singular factorisation gives NaN.
[[nodiscard]] std::vector<double> sweep(const Graph& graph, const std::vector<NodeId>& nodes,
                                        const std::vector<double>& inputs, bool rounded);

/// The nearest number with a significand of 24 bits [Veltkamp 1968].
[[nodiscard]] double to_24_bits(double x);

} // namespace lagen
