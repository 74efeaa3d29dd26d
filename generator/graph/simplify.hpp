// SPDX-License-Identifier: GPL-2.0-or-later
/// The portfolio: the same outputs as written, with like terms collected and common factors drawn out, and expanded under a term
/// budget and factored again; the form with the least weighted operations is kept.
#pragma once

#include "graph/graph.hpp"

namespace lagen {

/// Operation counts of what is reachable from some roots.
struct OperationCount {
    std::size_t additions = 0; ///< + - and unary minus that is not absorbed
    std::size_t multiplications = 0;
    std::size_t divisions = 0;
    std::size_t functions = 0; ///< sin and cos of one angle count once
    std::size_t solves = 0;
    double weight = 0;         ///< sum of the weights of the operator table
};

[[nodiscard]] OperationCount count_operations(const Graph& graph, std::span<const NodeId> roots);

/// The same values in the cheapest form found. Nodes of the result live in the same graph. Exact rational algebra only:
/// the values agree wherever the original is defined.
[[nodiscard]] std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs);

/// The same; `divisors` receives what rows of matrices were divided by: where one of these is zero, a matrix that stood
/// in the outputs is singular, and the new one may not be.
[[nodiscard]] std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs,
                                           std::vector<NodeId>& divisors);

} // namespace lagen
