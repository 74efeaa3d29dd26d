// SPDX-License-Identifier: GPL-2.0-or-later
/// Evidence for residuals beyond the budget of exact algebra: their values modulo the prime 2^61 - 1 at random points.
#pragma once

#include "graph/graph.hpp"

#include <cstdint>

namespace lagen::proof {

/// How many of `points` random assignments of residues make the node 0; fewer than `points` as soon as one does not.
/// sin and cos of one argument are (2 t, 1 - t^2)/(1 + t^2) for a t that depends on the argument's value, sqrt is the
/// root that is itself a square, every other function is a random function of its arguments. All zero is evidence,
/// wrong with a probability below (degree/2^61)^points, and never a proof; not zero says nothing. 0 where a divisor
/// vanishes.
[[nodiscard]] std::size_t modular_zeros(const Graph& graph, NodeId node, std::size_t points);

} // namespace lagen::proof
