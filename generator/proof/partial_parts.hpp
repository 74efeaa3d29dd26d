// SPDX-License-Identifier: GPL-2.0-or-later
/// What must be defined although the graph no longer shows it: 0*log(-1 - x^2) is the node 0, and yet defined nowhere.
#pragma once

#include "graph/core/lower.hpp"

namespace lagen {

/// Nodes of the partial operations in a tree as it is written (log, sqrt, asin, acos, tan, atan2, quotients, powers,
/// solutions of linear systems), branches of if left out; they belong into ProofSetting::defined. A quotient that
/// folded to something else, x/x to 1, is represented by 1 over its divisor.
[[nodiscard]] std::vector<NodeId> partial_parts(Graph& graph, Lowering& lower, const Tree& tree);

} // namespace lagen
