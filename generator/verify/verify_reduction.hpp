// SPDX-License-Identifier: GPL-2.0-or-later
/// Says whether the equations of motion of the source of a morphism project onto those of its target, component by
/// component, whatever is known of the map and of L. Each check is named `projects`, its indices are a form and a
/// component:
///   lagrange    x'^i: d/dt phi^i - rho'^i_a(phi) (Phi y)^a
///               y'^a: W'_ab d/dt(Phi y)^b - f'_a at (phi(x), Phi y), with ydot from W ydot = f;   W ydot = f the
///                     accelerations of mechanics/lagrange.hpp, forces included
///   hamilton    x'^i, and mu_b: d/dt(Phi^a_b mu'_a) - mudot_b at mu = Phi^* mu', with mu'dot from the target
///   pontryagin  the same at u' = psi(x, u, t) modulo dH'/du' = 0, u: dH/du - dH'/du' dpsi/du, and
///               y'^a: Phi^a_b sigma^b - sigma'^a(phi, psi)
///   discrete    DEL_b(g, h) - Phi^c_b(t(g)) DEL'_c(phi(g), phi(h))
/// Of nonholonomic systems y are the weights of sections, and the checks `constraint` of verify_morphism come first.
/// Forms that both sides have, Hamilton's where H is given. Of Lagrangians also what Phi does to E-paths, by checks
/// named `paths`:
///   variations  x'^i, y'^a: the image of delta_s less delta'_{Phi s}, mechanics/variations.hpp: TPhi Xi_a(s) =
///               Xi_{Phi a}(Phi s)
///   lifts       y^b: W ydot - f - Phi^* (W' d/dt(Phi y) - f'), so that E-paths over solutions are solutions, for every
///               rank of Phi                                                             [Martinez 2001, 2004, 2008]
#pragma once

#include "mechanics/morphism.hpp"
#include "verify/verify.hpp"

namespace lagen {

struct ReductionReport {
    StructureReport projects; ///< a `note` says that both sides have no form in common
    std::vector<Check> paths; ///< outside the verdict
};
[[nodiscard]] ReductionReport verify_reduction(const SystemMorphism& morphism, const ProofBudget& budget = {});

} // namespace lagen
