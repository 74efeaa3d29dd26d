// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton and Jacobi's equation for a section alpha of E*. With sigma^a = dH/dmu_a(x, alpha(x)):
///   closed             (d alpha)_ab = rho_a(alpha_b) - rho_b(alpha_a) - alpha_c C^c_ab = 0
///   Hamilton-Jacobi    rho_b(H o alpha) = 0: H o alpha is constant on the leaves
///   lift               rho(sigma)(alpha_b) + rho_b(H) + alpha_c C^c_bd sigma^d = 0: along the integral curves x(t) of
///                      rho(sigma) the momenta alpha(x(t)) solve Hamilton's equations (forces are subtracted)
/// Of a closed alpha, without forces, the left sides of the last two are the same. Along these curves the action is the
/// integral of alpha, S(x(t1)) - S(x(t0)) of alpha = dS: <alpha, sigma> = L(x, sigma) + H o alpha.   [Martinez 2001]
#pragma once

#include "geometry/form.hpp"
#include "mechanics/hamilton.hpp"

namespace lagen {

struct HamiltonJacobiNodes {
    ExteriorForm closed;          ///< d alpha
    std::vector<NodeId> equation; ///< rho_b(H o alpha), shape (r)
    std::vector<NodeId> lift;     ///< shape (r)
    std::optional<NodeId> action; ///< <alpha, sigma> - L(x, sigma) - H o alpha, of a system that has L
};

/// Of a system with `alpha`, shape (r). `hamiltonian` has no implicit velocities.
[[nodiscard]] HamiltonJacobiNodes hamilton_jacobi(Graph& graph, const System& system,
                                                  const HamiltonianNodes& hamiltonian,
                                                  const std::vector<NodeId>& alpha);

} // namespace lagen
