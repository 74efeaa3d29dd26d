// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions of one graph on another.
#pragma once

#include "graph/core/graph.hpp"

#include <map>

namespace lagen {

/// `outputs` of the graph `from` on the graph `to`, each input of `from` replaced by its node there; one that is not
/// listed becomes the input of the same name. Throws DivisionByZero where a divisor becomes the constant 0.
[[nodiscard]] std::vector<NodeId> transplant(Graph& to, const Graph& from, std::span<const NodeId> outputs,
                                             const std::map<NodeId, NodeId>& inputs);

} // namespace lagen
