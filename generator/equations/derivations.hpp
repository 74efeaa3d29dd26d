// SPDX-License-Identifier: GPL-2.0-or-later
/// `derive` chooses from these: the equations of a model in one form each, for a person to read. The formulas stand in
/// the files of the same names.
#pragma once

#include "equations/kept_symbols.hpp"
#include "mechanics/system.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"
#include "verify/verify.hpp"

#include <initializer_list>

namespace lagen {

class SymbolicModel;

/// Blocks: kinematics, labels of the leaves where there are any, momenta, equations of motion (momentum form),
/// (acceleration form), energy, energy balance where it is not zero; where L is degenerate, the kernel of W as far
/// as `regularity` has it. Throws MathematicsError where the model has no Lagrangian.
[[nodiscard]] EquationSet derive_lagrange(const Model& model, const WrittenAlgebroid& algebroid,
                                          const Regularity& regularity = {},
                                          Definitions definitions = Definitions::expanded);

/// The same with definitions of the model and parts that the equations share as symbols (shared_parts.hpp), where
/// without these they are long: nothing where they are not, or L is degenerate, or the model has Casimirs.
[[nodiscard]] std::optional<EquationSet> derive_long_lagrange(const Model& model, const System& system,
                                                              const Regularity& regularity);

/// Blocks: Hamiltonian, labels of the leaves where there are any, velocities, kinematics, equations of motion, energy
/// balance where it is not zero, Poisson brackets. Throws MathematicsError where the model has neither H nor L, and
/// where it has no H and `regularity` says that L is degenerate or its momenta are not shown to fix the velocities.
[[nodiscard]] EquationSet derive_hamilton(const Model& model, const WrittenAlgebroid& algebroid,
                                          const Regularity& regularity = {},
                                          Definitions definitions = Definitions::expanded);

/// Blocks: Hamiltonian, labels of the leaves where there are any, section of the controls, condition for the controls,
/// optimal angles (verify/angle_controls.hpp), where dH/du is affine in u with a regular matrix optimal controls and
/// maximal Hamiltonian (stationary controls alone where `maximum` is not proved), kinematics, equations of motion,
/// energy balance where it is not zero. Throws MathematicsError where the model has no controls, and where H has no
/// maximum or no dH/du.
[[nodiscard]] EquationSet derive_pontryagin(const Model& model, const WrittenAlgebroid& algebroid,
                                            const ControlMaximum& maximum,
                                            Definitions definitions = Definitions::expanded);

/// Throws MathematicsError where the model has no discrete Lagrangian that is written out.
[[nodiscard]] EquationSet derive_discrete(const Model& model, const System& system);

/// Throws MathematicsError likewise.
void require_written_discrete(const System& system);

/// A function of arrows without the entries of their matrices that are the same on the whole group.
[[nodiscard]] NodeId on_group(Graph& graph, const Groupoid& groupoid, std::initializer_list<Arrow> arrows, NodeId node);

/// Coordinates of these arrows, and the step, behind the names of the model in the order of terms.
void add_arrow_names(SymbolicModel& symbolic, const Graph& graph, std::initializer_list<Arrow> arrows);

/// Blocks: constraints as given, sections, brackets of sections, velocities, kinematics, momenta, equations of motion
/// in both forms, energy and its rate. Throws MathematicsError where the model has no Lagrangian.
[[nodiscard]] EquationSet derive_nonholonomic(const Model& model, const System& system,
                                              Definitions definitions = Definitions::expanded);

/// "reaction": lambda_a as functions of the state. "projected": the brackets of D; throws MathematicsError where L is
/// not of mechanical type or there is a drift. "hamilton": h = y^alpha p_alpha - l on D*, y(x, p), the equations of
/// motion, and where there is no drift the almost Poisson brackets. "poisson": these brackets, those of `functions`
/// over x and p in pairs, and the first triple of coordinates on which Jacobi's identity fails; throws where there is
/// a drift. All throw where accelerations, or y(x, p), are too long to be written out.
[[nodiscard]] EquationSet derive_nonholonomic_form(const std::string& form, const Model& model, const System& system,
                                                   const std::vector<Tree>& functions, Definitions definitions);

/// Throws MathematicsError where the model has no Lagrangian.
void require_lagrangian(const Model& model);

/// dx^i = rho^i_a e^a and de^c = -1/2 C^c_ab e^a ^ e^b, the sum over a < b, and A and dA of each form A of the model.
/// [Martinez 2001]
[[nodiscard]] EquationSet derive_exterior(const Model& model, const System& system);

/// The Poisson brackets of coordinates and of the functions F, G of `brackets` on E* (by pairs), Omega, and for all
/// (x, mu): Jacobi's identity, -d Theta = Omega, {F, G} = -Omega(X_F, X_G), and where the model has H (or an L whose
/// transform has a formula) i_{X_H} Omega = dH and Fdot = {H, F}.
[[nodiscard]] EquationSet derive_poisson(const Model& model, const System& system, const Regularity& regularity,
                                         const std::vector<Tree>& brackets,
                                         Definitions definitions = Definitions::expanded);

/// {mu_a, x^j} = rho^j_a and {mu_a, mu_b} = C^c_ab mu_c, those that are not zero.
[[nodiscard]] EquationBlock poisson_brackets(const SymbolicModel& symbolic);

/// Theta-(E-_a), Theta+(E+_a), Omega_L(E-_a, E+_b) without the entries that vanish, and for all arrows
///   dL = Theta+ - Theta-      with Theta-(E-_a) = -d/ds L(eta_a(s)^-1 g), Theta+(E+_a) = d/ds L(g eta_a(s))
///   ->e_a <-e_b L = <-e_b ->e_a L,   -dTheta- = Omega_L,   -dTheta+ = Omega_L
/// each proved, refuted or undecided, d of the algebroid of mechanics/cartan.hpp. Throws MathematicsError where the
/// model has no discrete Lagrangian that is written out.
[[nodiscard]] EquationSet derive_cartan(const Model& model, const System& system);

/// theta_L, omega_L, E_L and the complete lifts of the basis, and for all states
///   -d theta_L = omega_L,      i_Gamma omega_L = dE_L - Q_a X^a + (dp_a/dt) X^a,      d_Gamma theta_L = dL + ..
///   [e_a^c, e_b^c] = [e_a, e_b]^c,   [e_a^c, e_b^v] = [e_a, e_b]^v
/// with W_ab f^b of Lagrange's equations; whether omega_L is symplectic is what `regularity` says of W. Throws
/// MathematicsError where the model has no L.
[[nodiscard]] EquationSet derive_lagrangian_cartan(const Model& model, const System& system,
                                                   const Regularity& regularity);

/// delta x^i, delta y^a, delta p_a, Jacobi's equations, delta^2 L; and for all curves (x, y) with xdot = rho(y), all s,
/// r
///   delta_s (rho(y)) = d/dt (delta_s x),      [delta_s, delta_r] = delta_[s, r],      delta L = EL_a s^a + d/dt (p_a
///   s^a) d q/d s^a - d/dt (d q/d sdot^a) = delta EL_a + 1/2 C^c_ab s^b EL_c,      q = 1/2 delta^2 L
/// Throws MathematicsError where the model has no L, and where forces act.
[[nodiscard]] EquationSet derive_variations(const Model& model, const System& system);

/// xdot^i = X^i(t, x) as [rates] gives them, with constraints, Casimirs and invariants. Throws
/// MathematicsError where it gives none.
[[nodiscard]] EquationSet derive_first_order(const Model& model, const WrittenAlgebroid& algebroid,
                                             Definitions definitions);

/// The model has [control]. Throws MathematicsError where the derivation fails.
[[nodiscard]] EquationSet derive_control_variations(const Model& model, const System& system);

} // namespace lagen
