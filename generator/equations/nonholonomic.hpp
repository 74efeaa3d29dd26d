// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of a nonholonomic model (mechanics/nonholonomic.hpp), symbolic, for a person to read:
///   e_alpha = A_alpha^a e_a,   Y = b + y^alpha e_alpha,   xdot = rho(Y),   l(t, x, y) = L(t, x, Y)
///   [e_alpha, e_beta]^a = rho(e_alpha)(A_beta^a) - rho(e_beta)(A_alpha^a) + A_alpha^c A_beta^d C^a_cd
///   d/dt p_alpha = rho(e_alpha)(l) - P_a [e_alpha, Y]^a + P_a dA_alpha^a/dt + Q_alpha,   p_alpha = dl/dy^alpha, P =
///   dL/dY lambda_a = d/dt P_a - rho_a(L) + P_c C^c_ab Y^b - Q_a (reactions) [e_alpha, e_beta]_D = G^{gamma delta}
///   G(e_delta, [e_alpha, e_beta]) e_gamma        (projected; L = G(Y, Y)/2 - V)
/// [Cortes, de Leon, Marrero, Martinez 2009]
#pragma once

#include "equations/kept_symbols.hpp"
#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"

namespace lagen {

/// Blocks: constraints as given, sections, brackets of sections, velocities, kinematics, momenta, equations of motion
/// in both forms, energy and its rate. Throws MathematicsError where the model has no Lagrangian.
[[nodiscard]] EquationSet derive_nonholonomic(const Model& model, const System& system,
                                              Definitions definitions = Definitions::expanded);

/// lambda_a as functions of the state. Throws MathematicsError also where the accelerations are too long to be written
/// out.
[[nodiscard]] EquationSet derive_reaction(const Model& model, const System& system);

/// The brackets of D. Throws MathematicsError where L is not of mechanical type or there is a drift.
[[nodiscard]] EquationSet derive_projected(const Model& model, const System& system);

/// h = y^alpha p_alpha - l on D*, y(x, p), the equations of motion, and where there is no drift the almost Poisson
/// brackets. Throws MathematicsError also where y(x, p) is too long to be written out.
[[nodiscard]] EquationSet derive_constrained_hamilton(const Model& model, const System& system);

/// These brackets, those of `functions` over x and p in pairs, and the first triple of coordinates on which Jacobi's
/// identity fails. Throws MathematicsError also where there is a drift.
[[nodiscard]] EquationSet derive_almost_poisson(const Model& model, const System& system,
                                                const std::vector<Tree>& functions);

/// Throws MathematicsError where the model has no Lagrangian.
void require_lagrangian(const Model& model);

} // namespace lagen
