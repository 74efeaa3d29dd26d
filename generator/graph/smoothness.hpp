// SPDX-License-Identifier: GPL-2.0-or-later
/// Where an operation has all its derivatives in its operands.
#pragma once

#include "graph/graph.hpp"

namespace lagen {

/// A condition on a node, its `function`; on nothing where the operation is smooth everywhere.
struct SmoothWhere {
    enum class Condition { none, nonzero, positive } condition = Condition::none;
    NodeId function = 0;
};

/// Of one operation at its operands; the nodes of conditions that are none of them yet are made. Not told: atan2, whose
/// cut is no such set, select, and factorisations.
[[nodiscard]] SmoothWhere smooth_where(Graph& graph, NodeId node);

/// min, max and comparisons.
[[nodiscard]] bool compares(Op op);

/// Those, abs and sign: defined everywhere, smooth where `smooth_where` says.
[[nodiscard]] bool has_kink(Op op);

/// Operations that are single-valued and analytic in the complex plane, but for poles.
[[nodiscard]] bool is_meromorphic(Op op);

} // namespace lagen
