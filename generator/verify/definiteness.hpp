// SPDX-License-Identifier: GPL-2.0-or-later
/// Signs of matrices: where they have numbers by elimination, else by leading minors; of W = d2L/dy2 by the sign rule
/// (verify/convex_parts.hpp), which needs no determinant, else as it is.
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// The nodes as numbers; empty where one of them is none.
[[nodiscard]] std::vector<Rational> numbers_of(const Graph& graph, const std::vector<NodeId>& nodes);

/// True where a symmetric matrix of m rows is proved positive definite, by Sylvester's criterion. False means "not
/// shown", here and below.
[[nodiscard]] bool proves_matrix_definite(Graph& graph, const std::vector<NodeId>& entries, std::size_t m,
                                          const ZeroDecider& decider);

/// True where W is proved positive definite by the sign rule: no part is negative and, for the functions f of those
/// that are definite, df = 0 leaves y = 0 alone, one fibre coordinate after another: y^a = 0 where the df that hold no
/// other coordinate still open have sum_f (df/dy^a)^2 > 0.
[[nodiscard]] bool proves_definite_by_parts(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider);

/// True where W is proved positive definite wherever it is defined.
[[nodiscard]] bool proves_definite(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider);

/// True where W has no negative eigenvalue.
[[nodiscard]] bool proves_semidefinite(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider);

} // namespace lagen
