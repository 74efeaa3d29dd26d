// SPDX-License-Identifier: GPL-2.0-or-later
/// Where the fibre Hessian is singular, as equations.
#pragma once

#include "verify/reduced_fraction.hpp"

namespace lagen {

/// The factors of the numerator of a reduced fraction, without exponents and numbers; nothing where the node is too
/// long for that. Where it is defined the node vanishes exactly where one of them does.
[[nodiscard]] std::optional<std::vector<Tree>> factors_of(Graph& graph, NodeId node, const Order& order,
                                                          const ZeroDecider& decider);

/// The factors of `determinants` that are not proved to be nonzero once the inputs of `defaults` have their values: one
/// of the determinants vanishes exactly where one of these does. Empty where they are too long for a reader. `setting`
/// is that before the replacement, `valued` decides after it.
[[nodiscard]] std::vector<std::string> singular_factors(Graph& graph, const ProofSetting& setting,
                                                        const ZeroDecider& valued,
                                                        const std::vector<std::pair<NodeId, NodeId>>& defaults,
                                                        const std::vector<NodeId>& determinants);

} // namespace lagen
