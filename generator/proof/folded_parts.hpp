// SPDX-License-Identifier: GPL-2.0-or-later
/// What must be defined although the graph no longer shows it: 0*log(-1 - x^2) is the node 0, and yet defined nowhere.
#pragma once

#include "graph/lower.hpp"

namespace lagen {

/// Nodes of the partial operations in a tree (log, sqrt, asin, acos, tan, atan2, quotients, powers) that its own node
/// does not depend on, branches of if left out; they belong into ProofSetting::defined. A quotient that folded to a
/// constant is represented by 1 over its divisor. Memoised by tree address.
[[nodiscard]] std::vector<NodeId> folded_parts(Graph& graph, Lowering& lower, const Tree& tree);

} // namespace lagen
