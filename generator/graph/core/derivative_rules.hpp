// SPDX-License-Identifier: GPL-2.0-or-later
/// What the rows of the operator table say of derivatives. A contribution returns (d node / d operand k) * t with as
/// few new nodes as it can; a slope is a bound of |d node / d operand| that costs less than the derivative.
#pragma once

#include "graph/core/graph.hpp"

namespace lagen::rules {

// Contributions.
NodeId of_add(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_subtract(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_negate(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_multiply(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_divide(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_power(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_real_power(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_sqrt(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_sin(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_cos(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_tan(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_asin(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_acos(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_atan(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_atan2(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_sinh(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_cosh(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_tanh(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_exp(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_log(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_abs(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_stumpff(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_erf(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_minimum(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_maximum(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_step(Graph& graph, NodeId node, std::size_t k, NodeId t);
NodeId of_select(Graph& graph, NodeId node, std::size_t k, NodeId t);

// Slopes; a is the first operand, f the value.
NodeId slope_one(Graph& graph, NodeId node, std::size_t k);
NodeId slope_of_erf(Graph& graph, NodeId node, std::size_t k);          ///< 9/8 > 2/sqrt(pi)
NodeId slope_of_root(Graph& graph, NodeId node, std::size_t k);         ///< 1/(2 f)
NodeId slope_of_log(Graph& graph, NodeId node, std::size_t k);          ///< 1/|a|
NodeId slope_is_value(Graph& graph, NodeId node, std::size_t k);        ///< f: exp, and cosh, which is more than |sinh|
NodeId slope_of_sinh(Graph& graph, NodeId node, std::size_t k);         ///< |f| + 1
NodeId slope_of_tan(Graph& graph, NodeId node, std::size_t k);          ///< f^2 + 1
NodeId slope_of_real_power(Graph& graph, NodeId node, std::size_t k);   ///< |b f/a|, |f log(a)|
NodeId slope_of_inverse_sine(Graph& graph, NodeId node, std::size_t k); ///< 1/sqrt(1 - a^2)

/// 1 - a^2 of the operand a: under the roots of the derivatives of asin and acos.
NodeId complement_of(Graph& graph, NodeId node);

} // namespace lagen::rules
