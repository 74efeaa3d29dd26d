// SPDX-License-Identifier: GPL-2.0-or-later
/// Do the controls of Pontryagin's equations maximise H = mu_a sigma^a(t, x, u) - cost(t, x, u)? Without bounds they
/// solve dH/du = 0: a maximum where H is smooth and d2H/du2 < 0 for all u, or on the convex set of u where alone it is
/// defined. With bounds lo <= u <= hi the maximum is the
/// root of dH/du, or the bound next to it, where H is separable, and smooth and strictly concave on the interval.
/// Angles (verify/angle_controls.hpp) have their maximum in closed form, and the other controls stand apart from
/// them.
///                                                              [Pontryagin, Boltyanskii, Gamkrelidze, Mishchenko 1962]
#pragma once

#include "verify/verify.hpp"

namespace lagen {

/// Decides for all states of `setting`, all costates `mu` (inputs) and all parameters; `setting` is that of the whole
/// system.
[[nodiscard]] ControlMaximum decide_maximum(Graph& graph, const ControlProblem& control, const std::vector<NodeId>& mu,
                                            const ProofSetting& setting, const ProofBudget& budget);

/// Throws MathematicsError where the controls cannot be solved for in such a way that H may be largest.
void require_maximum(const std::string& model, const ControlMaximum& maximum);

} // namespace lagen
