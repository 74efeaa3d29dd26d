// SPDX-License-Identifier: GPL-2.0-or-later
/// The sign of a function on the whole domain.
#pragma once

#include "proof/normal_form.hpp"

namespace lagen::proof {

/// The signs that the value may have wherever everything is defined, from its normal forms: with the constraints and
/// without them, with sines of sums taken apart and whole. All of them where nothing is learnt.
[[nodiscard]] Signs domain_signs(const Graph& graph, const ProofSetting& setting,
                                 const std::vector<SolvedConstraint>& constraints,
                                 const std::vector<NonnegativeOperand>& operands, NodeId value, Work budget);

} // namespace lagen::proof
