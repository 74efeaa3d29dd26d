// SPDX-License-Identifier: GPL-2.0-or-later
/// Points of a model where the fibre Hessian is known to be singular.
#pragma once

#include "proof/decide.hpp"

namespace lagen {

/// One point on each slice "a variable is zero" on which everything is defined and one of `determinants` is proved to
/// vanish; eight at most.
[[nodiscard]] std::vector<NamedPoint> singular_points(Graph& graph, const ProofSetting& setting,
                                                      const ProofBudget& budget,
                                                      const std::vector<NodeId>& determinants);

} // namespace lagen
