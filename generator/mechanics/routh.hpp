// SPDX-License-Identifier: GPL-2.0-or-later
/// Routh's reduction of L(t, x, xdot) on TM by cyclic coordinates x^k, k in K:
///   p_k = dL/dy^k,   y^k = Theta^k(t, x, y, p) where p_k is affine in these velocities
///   R(t, x, y) = L(t, x, y, Theta) - p_k Theta^k,      for numbers p_k
/// The equations of R in the other coordinates are those of L on the level set of the momenta, with the gyroscopic
/// terms that R has where L joins velocities of both sorts.           [Routh 1877; Marsden, Ratiu and Scheurle 2000]
#pragma once

#include "mechanics/system.hpp"
#include "text/diagnostic.hpp"

namespace lagen {

/// The determinant of d2L/dy^k dy^l, k and l in K, is 0 everywhere.
class SingularMomenta : public MathematicsError {
  public:
    explicit SingularMomenta(const std::string& model);
};

struct Routhian {
    std::vector<std::size_t> cyclic; ///< K: coordinates, and sections of the same numbers
    std::vector<NodeId> y;           ///< their velocities y^k, inputs, shape (|K|)
    std::vector<NodeId> momenta;     ///< dL/dy^k over t, x and all velocities, shape (|K|)
    std::vector<NodeId> velocities;  ///< Theta^k over t, x, the other velocities and the inputs mu_k, shape (|K|)
    NodeId determinant = 0;          ///< of d2L/dy^k dy^l over t, x and the other velocities
    NodeId value = 0;                ///< R, where the determinant is not 0
};

/// Of a system with L on TM, where sections are d/dx^i in the order of the coordinates; `cyclic` ascends. Throws
/// MathematicsError where a momentum is not affine in the cyclic velocities, and where there are more than
/// `determinant_limit`; SingularMomenta where the determinant is the constant 0.
[[nodiscard]] Routhian routhian(Graph& graph, const System& system, std::vector<std::size_t> cyclic);

/// d/dt dF/dy^a - dF/dx^a for the velocities y^a of `sections`, at the accelerations ydot (of all sections).
[[nodiscard]] std::vector<NodeId> euler_lagrange(Graph& graph, const System& system, NodeId F,
                                                 const std::vector<std::size_t>& sections,
                                                 const std::vector<NodeId>& ydot);

} // namespace lagen
