// SPDX-License-Identifier: GPL-2.0-or-later
/// The sign rule: W = d2L/dy2 of a Lagrangian that is written as a sum of functions of one variable each, which may be
/// sums of such functions themselves, from
///   d2 (m g(f)) = m g'(f) d2f + m g''(f) df df^T,
/// so that m (J y + c)^2 gives 2 m J J^T and -m sqrt(1 - |y|^2) gives m/sqrt(..) 1 + m/sqrt(..)^3 y y^T. Products of
/// functions f that are affine in y give quadratic forms c_fg f g, and these sum_fg c_fg df dg^T. L is convex where all
/// c are positive semidefinite: sums of convex functions are convex.
#pragma once

#include "mechanics/fibre_hessian.hpp"

namespace lagen {

/// A part sum_fg c_fg df dg^T of W, where c is symmetric.
struct ConvexPart {
    std::vector<NodeId> functions;    ///< f, shape (m); affine in y where m > 1
    std::vector<NodeId> coefficients; ///< c_fg, shape (m, m), by rows
};

/// The parts whose sum is d2f/dy2, of any sign; nothing where f is not written in that way, or is affine in y.
[[nodiscard]] std::vector<ConvexPart> convex_parts(Graph& graph, NodeId f, const std::vector<NodeId>& y);

} // namespace lagen
