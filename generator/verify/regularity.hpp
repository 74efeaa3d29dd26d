// SPDX-License-Identifier: GPL-2.0-or-later
/// Regularity of the fibre Hessian W = d2L/dy2: generic rank by certified witnesses, `regular` only where det W is
/// proved nonzero on the whole domain, definiteness by leading minors.
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "proof/rank.hpp"
#include "symbolic/ginac_door.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// For all parameters, and by the same code for `values` (of the file) of those where that shows less than wanted.
[[nodiscard]] Regularity decide_regularity(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                                           const ZeroDecider& decider,
                                           const std::vector<std::pair<NodeId, NodeId>>& values);

// The kernel of a degenerate fibre Hessian W, a block of coupled coordinates at a time: for a nonzero principal minor
// det W_PP of the size of the rank and each j outside of P, k = e_j - (W_PP^-1 W_Pj)^i e_i.

/// Components that are not zero, by fibre coordinate.
using KernelVector = std::vector<std::pair<std::size_t, Tree>>;

/// The entries k at `places`; nothing where one is too long to be read.
[[nodiscard]] std::optional<KernelVector> readable_vector(Graph& graph, const std::vector<std::size_t>& places,
                                                          const std::vector<NodeId>& k, const Order& order,
                                                          const ZeroDecider& decider);

/// A basis of the kernel wherever minors and denominators do not vanish; W k = 0 is proved of each vector that is
/// listed. A vector is left out where that is not decided, where a component is too long to be read, and in blocks of
/// more than `determinant_limit` rows. `setting` orders the names.
[[nodiscard]] std::vector<KernelVector> kernel_vectors(Graph& graph, const FibreHessian& hessian,
                                                       const ZeroDecider& decider, const ProofSetting& setting);

} // namespace lagen
