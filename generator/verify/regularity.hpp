// SPDX-License-Identifier: GPL-2.0-or-later
/// Regularity of the fibre Hessian W = d2L/dy2: generic rank by certified witnesses, `regular` only where det W is
/// proved nonzero on the whole domain, definiteness by leading minors.
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// For all parameters, and by the same code for `values` (of the file) of those where that shows less than wanted.
[[nodiscard]] Regularity decide_regularity(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                                           const ZeroDecider& decider,
                                           const std::vector<std::pair<NodeId, NodeId>>& values);

} // namespace lagen
