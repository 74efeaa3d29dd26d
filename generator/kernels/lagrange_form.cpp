// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations (mechanics/lagrange.hpp) as kernels: ydot = W^-1 (..), never an inverse by symbols.
#include "graph/calculus/differentiate.hpp"
#include "kernels/formulation.hpp"
#include "mechanics/lagrange.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

void bind_names(const System& system, const LagrangianNodes& lagrangian, Formulation& form)
{
    form.binding["energy"] = form.binding["hamiltonian"] = lagrangian.energy;
    form.binding["lagrangian"] = *system.lagrangian;
    for (std::size_t a = 0; a < system.r(); ++a)
        form.binding[system.graph.input_name(system.mu[a])] = lagrangian.fibre.momenta[a];
    bind_system(system, form);
    for (const NodeId y : system.algebroid.y) form.binding[system.graph.input_name(y)] = y;
}

void add_kernels(Graph& graph, const System& system, const LagrangianNodes& lagrangian, NodeId power, bool hessians,
                 Formulation& form)
{
    const std::size_t r = system.r();
    if (r > 0) {
        form.kernels.push_back(table_kernel(form, "mass_matrix", matrix(graph, "W", r, r, lagrangian.fibre.hessian)));
        form.kernels.push_back(table_kernel(form, "momentum", column("p", lagrangian.fibre.momenta)));
    }
    form.kernels.push_back(scalar_kernel(form, "energy", lagrangian.energy));
    if (!graph.is_zero(power)) form.kernels.push_back(scalar_kernel(form, "power", power));
    form.kernels.push_back(scalar_kernel(form, "lagrangian", *system.lagrangian));
    if (!hessians) return;
    const std::vector<NodeId> first = gradient(graph, *system.lagrangian, state_of(form));
    form.kernels.push_back(hessian_kernel(graph, form, "lagrangian_hessian", first));
}

} // namespace

Formulation lagrange_form(Graph& graph, const System& system, const Report& report, const FormulationRequest& request)
{
    require_regular_lagrangian(system, report.mechanics.regularity, "Lagrangian");
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    const std::vector<NodeId>& W = lagrangian.fibre.hessian;
    graph.remember_hessian(W, system.algebroid.y, *system.lagrangian);
    const MomentumBalance balance = lagrange_balance(graph, system, lagrangian);
    Formulation form = empty_form(system, FormKind::lagrange, system.algebroid.y, request);
    form.derivative = base_velocity(graph, system.algebroid, system.algebroid.y);
    const std::vector<NodeId> right =
        acceleration_forces(graph, system, lagrangian, momentum_rates(graph, system.algebroid, balance));
    const std::vector<NodeId> ydot = graph.solve(W, right, mass_structure(report.mechanics.regularity));
    form.derivative.insert(form.derivative.end(), ydot.begin(), ydot.end());
    form.pivots = single_blocks(graph, W, system.r());
    form.documentation = {
        "The equations of motion, ds = (xdot, ydot): xdot^i = rho^i_a y^a and",
        system.forces.empty()
            ? "W_ab ydot^b = rho_a(L) - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b."
            : "W_ab ydot^b = rho_a(L) + Q_a - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b.",
        "s and ds may be the same object."};
    form.failures = "Answers singular_mass_matrix where W has no inverse at this state.";
    bind_names(system, lagrangian, form);
    append_state_rates(graph, system, form);
    add_kernels(graph, system, lagrangian, energy_rate(graph, system.algebroid, balance), request.hessians, form);
    return form;
}

} // namespace lagen
