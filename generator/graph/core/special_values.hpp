// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact values of functions at constant operands that are no rational numbers: sin(pi/2), atan(1), sqrt(2)^2,
/// log(exp(2)). A rule answers nothing where there is no value that is simpler than the call.
#pragma once

#include "graph/core/exact_rules.hpp"
#include "graph/core/graph.hpp"

namespace lagen::rules {

[[nodiscard]] std::optional<NodeId> special_value(Graph& graph, Op op, NodeId a);
/// Of atan2(a, b).
[[nodiscard]] std::optional<NodeId> special_angle(Graph& graph, NodeId a, NodeId b);
/// a^b of a positive a, where it is rational.
[[nodiscard]] Exact exact_real_power(const Rational& a, const Rational& b, std::size_t most_bits);
/// The value of a^2, of a product of numbers and square roots of numbers.
[[nodiscard]] std::optional<Rational> special_square(const Graph& graph, NodeId a);

} // namespace lagen::rules
