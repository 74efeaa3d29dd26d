// SPDX-License-Identifier: GPL-2.0-or-later
/// Controls that are angles: H = a + b cos u + c sin u, where a is free of u, and b and c are free of all controls. H
/// is largest where cos u = b / sqrt(b^2 + c^2), sin u = c / sqrt(b^2 + c^2); where b = c = 0 it does not depend on u.
#pragma once

#include "mechanics/pontryagin.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// b and c of an angle.
struct AngleTerms {
    NodeId b, c;
};

/// The numbers of the controls that are proved to be angles, for all states, costates and parameters: without bounds,
/// d3H/du3 + dH/du = 0, what stands in `parts` is smooth for all u, and b and c hold no control as they are written. A
/// control that H does not depend on is none of them.
[[nodiscard]] std::vector<std::size_t> find_angles(Graph& graph, const ControlProblem& control,
                                                   const ControlHamiltonian& hamiltonian,
                                                   const std::vector<NodeId>& parts, const ProofSetting& setting,
                                                   const ProofBudget& budget);

/// Of an angle u with dH/du = `slope`: b = -d2H/du2 and c = dH/du at u = 0.
[[nodiscard]] AngleTerms angle_terms(Graph& graph, NodeId slope, NodeId u);

/// The numbers below `count` that are not in `angles` (ascending).
[[nodiscard]] std::vector<std::size_t> other_controls(std::size_t count, const std::vector<std::size_t>& angles);

/// The problem of the other controls: what stands apart from the angles is the same where they vanish.
[[nodiscard]] ControlProblem without_angles(Graph& graph, const ControlProblem& control,
                                            const std::vector<std::size_t>& angles);

} // namespace lagen
