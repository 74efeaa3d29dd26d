// SPDX-License-Identifier: GPL-2.0-or-later
/// Definiteness of the fibre Hessian of a Lagrangian that is written as a sum of functions of one variable each, which
/// may be sums of such functions themselves: W = sum_i m_i J_i J_i^T, from
///   d2 (m g(f)) = m g'(f) d2f + m g''(f) df df^T,
/// so that m (J y + c)^2 gives 2 m J J^T and -m sqrt(1 - |y|^2) gives m/sqrt(..) 1 + m/sqrt(..)^3 y y^T. Products of
/// functions f that are affine in y give quadratic forms c_fg f g, and these sum_fg c_fg df dg^T: where c is positive
/// definite that is no less than a positive multiple of sum_f df df^T. No determinant of W is formed.
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// True where no m_i is negative, each c is positive definite and, among the J_i with a positive m_i and the df, J y =
/// 0 is proved to leave y = 0 alone, one fibre coordinate after another: y^a = 0 where the rows that hold no other
/// coordinate still open have sum_i J_ia^2 > 0. False means "not shown".
[[nodiscard]] bool proves_definite_by_squares(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider);

/// True where no m_i is negative and each c is positive definite, whatever the J_i are: W has no negative eigenvalue.
[[nodiscard]] bool proves_semidefinite_by_squares(Graph& graph, const FibreHessian& hessian,
                                                  const ZeroDecider& decider);

} // namespace lagen
