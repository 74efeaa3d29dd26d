// SPDX-License-Identifier: GPL-2.0-or-later
/// Long bodies in an order that keeps a processor busy. It starts an operation as soon as its operands are there, but
/// looks ahead by some hundred operations only: a chain of pivots that stands before the sums that it does not need
/// waits alone. Here what the end waits for longest comes first, and the rest fills the time.
#pragma once

#include "emit/order_body.hpp"

namespace lagen {

/// The same steps (of the kinds define, check and store), each after those that it reads; as they were where that
/// would save less than a twentieth of the time that a model of a processor takes for them.
[[nodiscard]] std::vector<BodyStep> overlap_steps(const Graph& graph, const BodyPlan& plan,
                                                  std::vector<BodyStep> steps);

} // namespace lagen
