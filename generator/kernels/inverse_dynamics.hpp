// SPDX-License-Identifier: GPL-2.0-or-later
/// Inverse dynamics: the inputs u that give accelerations ydot. Of Lagrange's equations W ydot = f(u) with f affine in
/// u
///   (df/du) u = W ydot - f(0),   df/du of shape (r, r).
#pragma once

#include "kernels/formulation.hpp"

namespace lagen {

/// Adds the kernel `inverse_dynamics` to Lagrange's form, whose W is `mass_matrix` and f `force`, where accelerations
/// determine the inputs: there are as many of both, f is affine in u, and df/du is proved to have an inverse at almost
/// every point.
void add_inverse_dynamics(Graph& graph, const System& system, const std::vector<NodeId>& mass_matrix,
                          const std::vector<NodeId>& force, Formulation& form);

} // namespace lagen
