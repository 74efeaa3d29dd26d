// SPDX-License-Identifier: GPL-2.0-or-later
/// Cayley's map on the graph, cay(A) = (1 - A/2)^-1 (1 + A/2), by matrices n x n by rows.
#pragma once

#include "geometry/groupoid.hpp"

namespace lagen {

/// W - 1; 1 + factor X
[[nodiscard]] std::vector<NodeId> less_one(Graph& graph, std::vector<NodeId> W, std::size_t n);
[[nodiscard]] std::vector<NodeId> one_and(Graph& graph, const Rational& factor, const std::vector<NodeId>& X,
                                          std::size_t n);

/// cay(A); cay(A) - 1 = (1 - A/2)^-1 A, of which small A lose nothing; the A with cay(A) = 1 + V, (1 + V/2)^-1 V.
[[nodiscard]] std::vector<NodeId> cayley(Graph& graph, const std::vector<NodeId>& A, std::size_t n);
[[nodiscard]] std::vector<NodeId> cayley_less_one(Graph& graph, const std::vector<NodeId>& A, std::size_t n);
[[nodiscard]] std::vector<NodeId> cayley_inverse(Graph& graph, const std::vector<NodeId>& V, std::size_t n);

} // namespace lagen
