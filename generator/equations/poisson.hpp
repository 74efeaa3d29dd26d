// SPDX-License-Identifier: GPL-2.0-or-later
/// The Poisson structure of E* for a person, with what is decided of it (mechanics/symplectic.hpp).
#pragma once

#include "equations/symbolic_model.hpp"
#include "mechanics/system.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// The Poisson brackets of coordinates and of the functions F, G of `brackets` on E* (by pairs), Omega, and for all
/// (x, mu): Jacobi's identity, -d Theta = Omega, {F, G} = -Omega(X_F, X_G), and where the model has H (or an L whose
/// transform has a formula) i_{X_H} Omega = dH and Fdot = {H, F}.
[[nodiscard]] EquationSet derive_poisson(const Model& model, const System& system, const Regularity& regularity,
                                         const std::vector<Tree>& brackets,
                                         Definitions definitions = Definitions::expanded);

/// {mu_a, x^j} = rho^j_a and {mu_a, mu_b} = C^c_ab mu_c, those that are not zero.
[[nodiscard]] EquationBlock poisson_brackets(const SymbolicModel& symbolic);

} // namespace lagen
