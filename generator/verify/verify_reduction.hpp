// SPDX-License-Identifier: GPL-2.0-or-later
/// Whether the equations of motion of the source of a morphism project onto those of its target, component by
/// component, whatever is known of the map and of L. Each check is named `projects`, its indices are a form and a
/// component:
///   lagrange    x'^i: d/dt phi^i - rho'^i_a(phi) (Phi y)^a
///               y'^a: W'_ab d/dt(Phi y)^b - f'_a at (phi(x), Phi y), with ydot from W ydot = f;   W ydot = f the
///                     accelerations of mechanics/lagrange.hpp, forces included
///   hamilton    x'^i, and mu_b: d/dt(Phi^a_b mu'_a) - mudot_b at mu = Phi^* mu', with mu'dot from the target
///   pontryagin  the same at u' = psi(x, u, t) modulo dH'/du' = 0, and u: dH/du - dH'/du' dpsi/du
///   discrete    DEL_b(g, h) - Phi^c_b(t(g)) DEL'_c(phi(g), phi(h))
/// Forms that both sides have, Hamilton's where H is given.                                     [Martinez 2001, 2004]
#pragma once

#include "mechanics/morphism.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// A `note` says that both sides have no form in common.
[[nodiscard]] StructureReport verify_reduction(const SystemMorphism& morphism, const ProofBudget& budget = {});

} // namespace lagen
