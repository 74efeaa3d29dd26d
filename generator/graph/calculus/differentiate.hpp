// SPDX-License-Identifier: GPL-2.0-or-later
/// Derivatives on the graph, exact, by the rules of the operator table. abs' = x/|x|; sign, comparisons have derivative
/// 0; select, minimum and maximum differentiate their branches. A solve z = A^-1 b has dz = A^-1 (db - dA z) on the
/// same factorisation; adjoint: lambda = A^-T zbar, bbar = lambda, Abar = -lambda z^T (A^T shares the factor where A is
/// symmetric).
#pragma once

#include "graph/core/graph.hpp"

#include <optional>

namespace lagen {

/// Forward mode: the directional derivatives of `outputs` along `seeds` (pairs input node, its tangent); one sweep.
/// Inputs without a seed have tangent 0.
[[nodiscard]] std::vector<NodeId> directional(Graph& graph, std::span<const NodeId> outputs,
                                              std::span<const std::pair<NodeId, NodeId>> seeds);

/// Reverse mode: d output / d input for each of `inputs`; one sweep.
[[nodiscard]] std::vector<NodeId> gradient(Graph& graph, NodeId output, std::span<const NodeId> inputs);

/// d outputs[r] / d inputs[c], by forward sweeps; result[r][c].
[[nodiscard]] std::vector<std::vector<NodeId>> jacobian(Graph& graph, std::span<const NodeId> outputs,
                                                        std::span<const NodeId> inputs);

/// The rows of such a matrix one after another.
[[nodiscard]] std::vector<NodeId> joined_rows(const std::vector<std::vector<NodeId>>& rows);

/// The same outputs with inputs replaced by nodes (simultaneously). Throws DivisionByZero where a divisor becomes the
/// constant 0.
[[nodiscard]] std::vector<NodeId> substitute(Graph& graph, std::span<const NodeId> outputs,
                                             std::span<const std::pair<NodeId, NodeId>> replacements);

/// The same, and nothing where a divisor becomes the constant 0: the outputs are not defined there.
[[nodiscard]] std::optional<std::vector<NodeId>>
substitute_where_defined(Graph& graph, std::span<const NodeId> outputs,
                         std::span<const std::pair<NodeId, NodeId>> replacements);

} // namespace lagen
