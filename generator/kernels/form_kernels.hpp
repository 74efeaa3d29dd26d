// SPDX-License-Identifier: GPL-2.0-or-later
/// The kernels of one form of a model, differentiated on the graph from the user's own form of rho, C, L, H, cost.
/// State lanes: x^i (n), then y^a or mu_a (r).
///   rhs           the equations of motion (kernels/formulation.hpp)
///   jacobian      d rhs / d state, sparse, by columns where entries would be long;  variational: d rhs / d state * v
///   input_jacobian  d rhs / d inputs, sparse, where the model has inputs and no scene gives them
///   of hamilton, on request: flows, the exact flows of parts of H (kernels/exact_flows.hpp), as flow_0, flow_1, ..
///   taylor        the Taylor coefficients of the motion, order by order, on request
///   constraints, domain, observables, invariants, events: vectors in the order of the model
///   jumps         the states behind events that jump, a column each (kernels/jumps.hpp)
///   of lagrange: mass_matrix, momentum, energy, power, lagrangian; lagrangian_hessian on request; inverse_dynamics,
///                where accelerations determine the inputs (kernels/inverse_dynamics.hpp)
///   of hamilton: velocity, energy, power, hamiltonian, lagrangian; hamiltonian_hessian on request
///   of pontryagin: controls, hamiltonian, power, cost
#pragma once

#include "graph/kernel.hpp"
#include "graph/simplify/simplify.hpp"
#include "model/model.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// What the simplification of one kernel tried.
struct KernelReport {
    std::string kernel;
    SimplifyReport report;
};

struct KernelRequest {
    std::string form;                 ///< empty: default_form(model)
    std::vector<std::string> only;    ///< kernel names wanted; empty: all that are not made on request alone
    std::vector<std::string> with;    ///< and these
    std::vector<std::string> without; ///< but not these
    bool flows = false;               ///< and `flows` where the right-hand side does not separate and there are any
    Tree time_scale = nullptr;        ///< not null: and the kernel time_scale, of this observable
    const Scene* scene = nullptr; ///< events and observed expressions of this scene only; null: events of every scene
    std::vector<KernelReport>* reports = nullptr; ///< receives one a kernel, in their order
};

/// Throws MathematicsError where the model has no such form.
[[nodiscard]] KernelModule form_kernels(const Model& model, const System& system, const Report& report,
                                        const KernelRequest& request = {});

} // namespace lagen
