// SPDX-License-Identifier: GPL-2.0-or-later
/// The interpreter: the reference for every compiled kernel. One loop over the reachable nodes in any scalar with the
/// elementary functions found by ADL or in std (float, double, long double, __float128 through <quadmath.h> is not
/// needed, a multiprecision number, an interval).
#pragma once

#include "graph/core/graph.hpp"

#include <functional>
#include <map>

namespace lagen {

/// The values of `outputs` in double, long double, given values of the inputs (missing input: InternalError). A
/// singular factorisation gives NaN. Instantiated for float, double, long double.
template <class Scalar>
[[nodiscard]] std::vector<Scalar> evaluate(const Graph& graph, std::span<const NodeId> outputs,
                                           const std::map<std::string, Scalar>& inputs);

/// Exact rational values, where every reachable operation is rational; empty otherwise (or on a division by zero).
[[nodiscard]] std::vector<Rational> evaluate_exactly(const Graph& graph, std::span<const NodeId> outputs,
                                                     const std::map<std::string, Rational>& inputs);

} // namespace lagen
