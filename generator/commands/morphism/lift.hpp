// SPDX-License-Identifier: GPL-2.0-or-later
/// Reconstruction: from a solution of the target of a morphism that is an isomorphism of fibres, and the start of the
/// source, the motion of the source, x' = rho(x) Phi(x)^-1 y'(t).                              [Martinez 2001, Theorem
/// 3]
#pragma once

#include "mechanics/morphism.hpp"
#include "scene/evaluate_scene.hpp"

namespace lagen {

struct LiftedTarget {
    Model model;                    ///< the target with the base coordinates of the source as first-order states
    std::vector<std::string> names; ///< of these states
};

/// Phi^-1 by Cramer's rule, of a map that is shown to be an isomorphism of fibres: then these have no more than
/// `determinant_limit` coordinates. `parameters` of the source are numbers in the rates.
[[nodiscard]] LiftedTarget lifted_target(const Model& target, const SystemMorphism& map,
                                         const std::vector<NamedNumber>& parameters);

} // namespace lagen
