// SPDX-License-Identifier: GPL-2.0-or-later
/// Pontryagin's equations on E*, normal extremals, with u where H(t, x, mu, u) = mu_a sigma^a - cost is largest:
///   xdot^i = rho^i_a sigma^a,   mudot_a = -(rho_a(H) + mu_c C^c_ab sigma^b)                [Martinez 2004; MATH 10]
/// Where no bound is reached dH/du = 0; where dH/du is affine in u these are the linear equations
///   W u = dH/du at u = 0,   W = -d2H/du2
#pragma once

#include "mechanics/fibre_hessian.hpp"
#include "mechanics/phase_motion.hpp"

namespace lagen {

/// H with its derivatives in the N controls of a problem.
struct ControlHamiltonian {
    NodeId value = 0;
    std::vector<NodeId> dH_du; ///< shape (N)
    FibreHessian negative;     ///< of -H in u, with W as its Hessian: positive where H is concave
};
[[nodiscard]] ControlHamiltonian control_hamiltonian(Graph& graph, const ControlProblem& control,
                                                     const std::vector<NodeId>& mu);

/// dH/du = 0 as equations for the controls.
struct ControlEquations {
    FibreHessian negative;                    ///< of -H; W is simplified
    std::optional<std::vector<NodeId>> right; ///< dH/du at u = 0, shape (N), where dH/du is affine in u
};
[[nodiscard]] ControlEquations control_equations(Graph& graph, const ControlHamiltonian& hamiltonian);

/// f = -H with the controls, pairs for `substitute`, at these values; dH/du need not be known, since it vanishes or the
/// control stands at a constant.
[[nodiscard]] PhaseSystem pontryagin_system(Graph& graph, const System& system, NodeId hamiltonian,
                                            Replacements controls);

/// The same for proofs: controls without bounds, in which dH/du is affine and d2H/du2 is regular, are solved for by
/// Cramer's rule, a block of coupled controls at a time. The others stay open, with the reason as `obstacle`.
[[nodiscard]] PhaseSystem solved_pontryagin_system(Graph& graph, const System& system);

} // namespace lagen
