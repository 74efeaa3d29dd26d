// SPDX-License-Identifier: GPL-2.0-or-later
/// From a point where a function is not zero to almost all points: an analytic function on a connected set that is zero
/// on an open part of it is zero everywhere. Functions with a kink or several branches (|x|, sqrt, log, atan) need not
/// be: |x| + x is zero on a half line.
#pragma once

#include "graph/core/operators.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// True where f is proved to be nonzero on a set whose complement has no inner points. Sums, products, quotients,
/// powers and functions that are single-valued in the complex plane are analytic off the zeros of their divisors, which
/// do not cut a complex neighbourhood in two. Of at most three roots and absolute values the product of f over all
/// signs is such a function too: f is nonzero where that is. Constraints on what f depends on must be spheres and other
/// regular quadrics. Logarithms and other inverse functions are allowed where the domain is given by affine
/// inequalities alone and they are analytic on all of it, or have affine operands.
[[nodiscard]] bool is_nonzero_almost_everywhere(Graph& graph, NodeId f, const ProofSetting& setting,
                                                const ZeroDecider& decider);

/// True where polynomials in `functions` that are nonzero at one point are so almost everywhere: as above, with roots
/// too analytic on all of the domain, and solutions of linear systems, which are quotients.
[[nodiscard]] bool are_analytic(Graph& graph, const std::vector<NodeId>& functions, const ProofSetting& setting,
                                const ZeroDecider& decider);

} // namespace lagen
