// SPDX-License-Identifier: GPL-2.0-or-later
/// Which nodes of a function body get a name, and in which order they are computed: each next to its first use, sine
/// and cosine of one angle side by side, so that a compiler merges them into one call. Stumpff functions of one
/// argument are all named: they come from one call.
#pragma once

#include "graph/graph.hpp"

namespace lagen {

struct BodyPlan {
    std::vector<NodeId> order; ///< named nodes, factors and solves, in order of evaluation
    std::vector<bool> named;   ///< by node: stands in `order`
    std::vector<bool> used;    ///< by node: reachable from the outputs
};

[[nodiscard]] BodyPlan plan_body(const Graph& graph, std::span<const NodeId> outputs);

/// True where a power is spelled out by a chain of squares, a statement each (|exponent| > 4).
[[nodiscard]] bool needs_chain(const Graph& graph, NodeId id);

} // namespace lagen
