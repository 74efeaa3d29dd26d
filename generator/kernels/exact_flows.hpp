// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton's equations of H = V(x, t) + T(mu) as a sum of fields whose flows have a closed form:
///   the kick          xdot^i = 0,             mudot_b = -rho^i_b dV/dx^i + Q_b(x, t)
///   of momentum a     xdot^i = rho^i_a y^a,   mudot_b = -mu_c C^c_ba y^a,            y^a = dT/dmu_a
/// The second one keeps mu_a. It is y^a times the field A_a that the function mu_a has by the Poisson bracket, and A_a
/// commutes with A_b where C^c_ab = 0. Momenta of which all do make one part: their y^a are constant along it, and its
/// flow for the time h is that of each A_a for the time h y^a, one after another.
///
/// The flow of A for the time theta moves a lane z by what A z, A A z, .. tell. Where A^j z = 0 it is a polynomial in
/// theta, and where A^(k+2) z = c A^k z with A c = 0
///   sum_{0<j<k} theta^j/j! A^j z + theta^k c_k(-c theta^2) A^k z + theta^(k+1) c_(k+1)(-c theta^2) A^(k+1) z
/// with Stumpff's functions c_k (a rotation for k = 1, c < 0). The zero decision proves each of these equations.
#pragma once

#include "mechanics/hamilton.hpp"

#include <string>

namespace lagen {

struct ExactFlow {
    std::vector<NodeId> increments; ///< of x, then of mu, in the time `length`
    std::string part;               ///< of H: "V(x)", "T(p1, p2)"
};

struct ExactFlows {
    NodeId length = 0;            ///< an input
    std::vector<ExactFlow> parts; ///< the kick first, where there is one; empty: there is an obstacle
    std::string obstacle;         ///< in names of the model
};

[[nodiscard]] ExactFlows exact_flows(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian);

} // namespace lagen
