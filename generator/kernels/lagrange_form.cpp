// SPDX-License-Identifier: GPL-2.0-or-later
/// W_ab ydot^b = rho_a(L) + Q_a - [d/dt p_a along (xdot, 1) at fixed y] - p_c C^c_ab y^b                [Martinez 2001]
#include "geometry/momentum_balance.hpp"
#include "graph/differentiate.hpp"
#include "kernels/formulation.hpp"
#include "kernels/lagrangian.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// The acceleration form; (d2L/dy dx) rho y + d2L/dy dt by one forward sweep of p along (xdot, 1).
std::vector<NodeId> accelerations(Graph& graph, const SystemNodes& system, const LagrangianNodes& lagrangian,
                                  const std::vector<NodeId>& xdot, const std::vector<NodeId>& forces,
                                  MatrixStructure structure)
{
    std::vector<std::pair<NodeId, NodeId>> seeds;
    for (std::size_t i = 0; i < xdot.size(); ++i) seeds.emplace_back(system.x[i], xdot[i]);
    seeds.emplace_back(system.time, graph.constant(1));
    const std::vector<NodeId> drift = directional(graph, lagrangian.momentum, seeds);
    std::vector<NodeId> right = along_anchor(graph, system, lagrangian.dL_dx);
    for (std::size_t a = 0; a < right.size(); ++a) right[a] = graph.subtract(graph.add(right[a], forces[a]), drift[a]);
    subtract_brackets(graph, system, lagrangian.momentum, lagrangian.y, right);
    return graph.solve(lagrangian.W, right, structure);
}

void bind_names(const Model& model, const SystemNodes& system, const LagrangianNodes& lagrangian, Formulation& form)
{
    form.binding["energy"] = form.binding["hamiltonian"] = lagrangian.energy;
    form.binding["lagrangian"] = lagrangian.value;
    for (std::size_t a = 0; a < model.fibre.momenta.size() && a < lagrangian.momentum.size(); ++a)
        form.binding[model.fibre.momenta[a].name] = lagrangian.momentum[a];
    for (const auto& [name, node] : system_names(model, system)) form.binding[name] = node;
    for (std::size_t a = 0; a < lagrangian.y.size(); ++a)
        form.binding[model.fibre.coordinates[a].name] = lagrangian.y[a];
}

void add_kernels(Graph& graph, const LagrangianNodes& lagrangian, NodeId power, const FormulationParts& parts,
                 Formulation& form)
{
    const std::size_t r = lagrangian.y.size();
    if (r > 0) {
        form.kernels.push_back({"mass_matrix",
                                KernelShape::matrix,
                                matrix(graph, "W", r, r, lagrangian.W),
                                {fmt::format("W_ab = d2L/dy^a dy^b, shape ({}, {}), symmetric.", r, r)},
                                {},
                                {}});
        form.kernels.push_back({"momentum",
                                KernelShape::vector,
                                column("p", lagrangian.momentum),
                                {fmt::format("p_a = dL/dy^a, shape ({}).", r)},
                                {},
                                {}});
    }
    form.kernels.push_back(scalar_kernel("energy", lagrangian.energy, "E = y^a p_a - L."));
    if (!graph.is_zero(power))
        form.kernels.push_back(scalar_kernel("power", power, "dE/dt = Q_a y^a - dL/dt along the motion."));
    form.kernels.push_back(scalar_kernel("lagrangian", lagrangian.value, "L(t, x, y)."));
    if (!parts.hessians) return;
    const std::vector<NodeId> first = gradient(graph, lagrangian.value, state_of(form));
    form.kernels.push_back(hessian_kernel(graph, "lagrangian_hessian", first, form, "d2L/ds2"));
}

} // namespace

Formulation lagrange_form(Graph& graph, const Model& model, const VerifiedAlgebroid& verified,
                          const FormulationParts& parts)
{
    require_regular_lagrangian(model, verified.regularity, "Lagrangian");
    const SystemNodes system = system_nodes(graph, model, verified.algebroid);
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, model, system);
    Formulation form;
    form.form = "lagrange";
    form.time = system.time;
    form.parameters = system.parameters;
    form.x = system.x;
    form.lanes = lagrangian.y;
    form.lane_names = model.fibre.coordinates;
    form.lane_group = "Fibre";
    Lowering lower(graph);
    const std::vector<NodeId> forces = generalized_forces(graph, lower, model, lagrangian.y);
    if (parts.motion) {
        form.derivative = base_velocity(graph, system, lagrangian.y);
        const std::vector<NodeId> ydot =
            accelerations(graph, system, lagrangian, form.derivative, forces, mass_structure(verified.regularity));
        form.derivative.insert(form.derivative.end(), ydot.begin(), ydot.end());
        form.pivots = single_blocks(graph, lagrangian.W, lagrangian.y.size());
    }
    const bool forced = !model.forces.empty() || model.dissipation;
    form.documentation = {
        "The equations of motion, ds = (xdot, ydot): xdot^i = rho^i_a y^a and",
        forced ? "W_ab ydot^b = rho_a(L) + Q_a - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b."
               : "W_ab ydot^b = rho_a(L) - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b.",
        "Answers singular_mass_matrix where W has no inverse at this state; what depends on the parameters alone is",
        "checked by parameter_status() instead, once. s and ds may be the same object."};
    bind_names(model, system, lagrangian, form);
    const NodeId power = graph.subtract(contraction(graph, forces, lagrangian.y), lagrangian.dL_dt);
    add_kernels(graph, lagrangian, power, parts, form);
    return form;
}

} // namespace lagen
