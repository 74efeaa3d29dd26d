// SPDX-License-Identifier: GPL-2.0-or-later
/// The kernels of the Lagrangian formulation, differentiated on the graph from the user's own form of rho, C and L.
/// State lanes: x^i (n), then y^a (r).
///   rhs           xdot^i = rho^i_a y^a;  W ydot = rho_a(L) - (d2L/dy dx) rho y - d2L/dy dt - p_c C^c_ab y^b by `solve`
///   mass_matrix   W_ab, shape (r, r);  momentum p_a, shape (r);  energy, lagrangian: scalars
///   constraints, observables, invariants, events: vectors in the order of the model
#pragma once

#include "geometry/verify.hpp"
#include "graph/kernel.hpp"

namespace lagen {

struct KernelRequest {
    std::vector<std::string> only; ///< kernel names wanted; empty: all
    const Scene* scene = nullptr;  ///< events and observed expressions of this scene only; null: events of every scene
};

/// Throws MathematicsError where there is no Lagrangian or it is degenerate.
[[nodiscard]] KernelModule lagrange_kernels(const Model& model, const VerifiedAlgebroid& verified,
                                            const KernelRequest& request = {});

} // namespace lagen
