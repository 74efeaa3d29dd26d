// SPDX-License-Identifier: GPL-2.0-or-later
/// Definiteness of the fibre Hessian of a Lagrangian that is written as a sum of squares, L = sum_i m_i (J_i y + c_i)^2
/// + (terms of degree 1 and 0 in y): W = 2 sum_i m_i J_i J_i^T. No determinant is formed.
#pragma once

#include "geometry/fibre_hessian.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// True where all m_i are proved positive and J y = 0 is proved to leave y = 0 alone, one fibre coordinate after
/// another: y^a = 0 where the rows that hold no other coordinate still open have sum_i J_ia^2 > 0. False means "not
/// shown".
[[nodiscard]] bool proves_definite_by_squares(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider);

} // namespace lagen
