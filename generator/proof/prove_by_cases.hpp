// SPDX-License-Identifier: GPL-2.0-or-later
/// Proofs that need more than a normal form: roots by their norms and signs, sums of inverse angles, and distinctions
/// of cases by the sign of what stands under |.|, min, max, sign and if.
#pragma once

#include "proof/normal_form.hpp"

namespace lagen::proof {

/// True where the node is proved to vanish wherever everything is defined. Every case of a distinction must be proved,
/// excluded by the facts, or undefined; at most 81 cases, each within `budget`. Assumes that the node is defined
/// somewhere.
[[nodiscard]] bool proves_by_cases(const Graph& graph, const ProofSetting& setting,
                                   const std::vector<SolvedConstraint>& constraints,
                                   const std::vector<NonnegativeOperand>& operands, NodeId node, Work budget);

// The sign of a function on the whole domain.

/// The signs that the value may have wherever everything is defined, from its normal forms: with the constraints and
/// without them, with sines of sums taken apart and whole. All of them where nothing is learnt.
[[nodiscard]] Signs domain_signs(const Graph& graph, const ProofSetting& setting,
                                 const std::vector<SolvedConstraint>& constraints,
                                 const std::vector<NonnegativeOperand>& operands, NodeId value, Work budget);

} // namespace lagen::proof
