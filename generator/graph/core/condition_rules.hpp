// SPDX-License-Identifier: GPL-2.0-or-later
/// What the rows of the operator table say of domains: the sense in which the operands are restricted, and the function
/// of them that is.
#pragma once

#include "graph/core/operators.hpp"

namespace lagen::rules {

template <Sense sense>
Sense where(const Graph&, NodeId)
{
    return sense;
}

inline Sense where_power(const Graph& graph, NodeId node)
{
    return static_cast<std::int32_t>(graph.payload(node)) < 0 ? Sense::nonzero : Sense::always;
}

/// x >= 0 for a number that is positive, else x > 0: x^y is exp(y log(x)) for any other y.
inline Sense where_real_power(const Graph& graph, NodeId node)
{
    const NodeId exponent = graph.operands(node)[1];
    return graph.is_constant(exponent) && sgn(graph.value(exponent)) > 0 ? Sense::nonnegative : Sense::positive;
}

inline Sense where_regular(const Graph& graph, NodeId node)
{
    const bool proved = graph.payload(node) == static_cast<std::uint32_t>(MatrixStructure::positive_definite);
    return proved ? Sense::always : Sense::regular;
}

inline NodeId difference_of(Graph& graph, NodeId node)
{
    const NodeId a = graph.operands(node)[0];
    return graph.subtract(a, graph.operands(node)[1]);
}

inline NodeId cosine_of(Graph& graph, NodeId node)
{
    return graph.apply(Op::cos, graph.operands(node)[0]);
}

} // namespace lagen::rules
