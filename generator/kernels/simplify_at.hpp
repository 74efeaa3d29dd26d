// SPDX-License-Identifier: GPL-2.0-or-later
/// Simplification in place: of nodes that stand in the members of kernels and implicit blocks.
#pragma once

#include "graph/simplify/simplify.hpp"
#include "graph/unknowns/implicit.hpp"

#include <initializer_list>
#include <vector>

namespace lagen {

/// Simplifies the nodes at these places together, and answers their divisors.
std::vector<NodeId> simplify_at(Graph& graph, const std::vector<NodeId*>& places, SimplifyReport* report = nullptr);

/// The same for all nodes of these lists.
void simplify_at(Graph& graph, std::initializer_list<std::vector<NodeId>*> lists);

/// Residuals, Jacobian and guess of each block, simplified together.
void simplify_blocks(Graph& graph, std::vector<ImplicitBlock>& blocks);

} // namespace lagen
