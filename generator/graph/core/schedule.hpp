// SPDX-License-Identifier: GPL-2.0-or-later
/// An evaluation order for a set of outputs: which nodes become named temporaries, and in which order.
#pragma once

#include "graph/core/graph.hpp"

namespace lagen {

/// `temporaries` are the reachable nodes that deserve a name, in order of evaluation (operands first, few live values):
/// nodes that are used more than once, all operands of `factor` and `solve` that are neither leaves nor constants, and
/// every `factor` and `solve` itself. Leaves (constants, pi, inputs), `component` and cheap signs of leaves are never
/// temporaries; every other node has one use and is printed inside it.
struct Schedule {
    std::vector<NodeId> temporaries;
    std::vector<std::uint32_t> uses; ///< by node id (graph.size() entries): operands and outputs that refer to the node
};

[[nodiscard]] Schedule schedule(const Graph& graph, std::span<const NodeId> outputs);

} // namespace lagen
