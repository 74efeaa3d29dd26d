// SPDX-License-Identifier: GPL-2.0-or-later
/// xdot^i = rho^i_a y^a,   mudot_a = -(rho_a(H) + mu_c C^c_ab y^b) + Q_a,   y^a = dH/dmu_a               [Martinez
/// 2001] From L without forming H: y solves mu_a = dL/dy^a, and at that y dH/dx^i = -dL/dx^i, dH/dt = -dL/dt.
#include "geometry/legendre_obstacle.hpp"
#include "geometry/momentum_balance.hpp"
#include "graph/differentiate.hpp"
#include "graph/simplify.hpp"
#include "kernels/formulation.hpp"
#include "kernels/lagrangian.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

using Replacements = std::vector<std::pair<NodeId, NodeId>>;

/// Everything of H that its equations need, over x, mu and, where y is implicit, the unknowns y.
struct HamiltonianNodes {
    NodeId value = 0;
    std::vector<NodeId> mu;    ///< input nodes, shape (r)
    std::vector<NodeId> y;     ///< dH/dmu_a, shape (r)
    std::vector<NodeId> dH_dx; ///< at fixed mu, shape (n)
    NodeId dH_dt = 0;
    std::optional<NodeId> lagrangian;
    std::vector<NodeId> pivots;
    std::vector<ImplicitBlock> implicit;
};

/// From [hamiltonian] H.
HamiltonianNodes given_hamiltonian(Graph& graph, const Model& model, const SystemNodes& system, HamiltonianNodes nodes)
{
    nodes.value = Lowering(graph)(model.hamiltonian);
    Slopes slopes = slopes_of(graph, nodes.value, nodes.mu, system);
    nodes.y = std::move(slopes.lanes);
    nodes.dH_dx = std::move(slopes.x);
    nodes.dH_dt = slopes.t;
    return nodes;
}

/// From L: y(x, mu) by a linear solve where p is affine in y, else an implicit block.
HamiltonianNodes legendre(Graph& graph, const Model& model, const SystemNodes& system, const Regularity& regularity,
                          HamiltonianNodes nodes)
{
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, model, system);
    const std::size_t r = lagrangian.y.size();
    const MatrixStructure structure = mass_structure(regularity);
    std::vector<NodeId> W = lagrangian.W;
    if (depends_on_any(graph, W, lagrangian.y)) {
        std::vector<NodeId> divisors;
        W = simplify(graph, W, divisors);
    }
    std::vector<NodeId> residuals(r);
    for (std::size_t a = 0; a < r; ++a) residuals[a] = graph.subtract(lagrangian.momentum[a], nodes.mu[a]);
    const std::vector<NodeId> zeros(r, graph.constant(0));
    Replacements velocities;
    // Of a momentum that is affine in y the root may lie where L is not defined: what must be positive has cancelled.
    if (depends_on_any(graph, W, lagrangian.y) || !positive_operands(graph, lagrangian.value, lagrangian.y).empty()) {
        nodes.implicit.push_back(gradient_block(graph, "velocity", "y with dL/dy^a = mu_a (the Legendre transform).",
                                                lagrangian.y, residuals, lagrangian.value, regularity.newton_start));
        nodes.implicit.back().structure = structure;
        nodes.y = lagrangian.y;
    } else {
        std::vector<NodeId> right = substitute(graph, residuals, replacements(lagrangian.y, zeros));
        for (NodeId& entry : right) entry = graph.negate(entry);
        nodes.y = graph.solve(W, right, structure);
        nodes.pivots = single_blocks(graph, W, r);
        velocities = replacements(lagrangian.y, nodes.y);
    }
    std::vector<NodeId> all = lagrangian.dL_dx;
    all.push_back(lagrangian.dL_dt);
    all.push_back(lagrangian.value);
    if (!velocities.empty()) all = substitute(graph, all, velocities);
    nodes.lagrangian = all.back();
    nodes.dH_dt = graph.negate(all[all.size() - 2]);
    nodes.dH_dx.assign(all.begin(), all.end() - 2);
    for (NodeId& entry : nodes.dH_dx) entry = graph.negate(entry);
    nodes.value = graph.subtract(contraction(graph, nodes.mu, nodes.y), all.back());
    return nodes;
}

void bind_names(const Model& model, const SystemNodes& system, const HamiltonianNodes& hamiltonian, Formulation& form,
                Graph& graph)
{
    form.binding["energy"] = form.binding["hamiltonian"] = hamiltonian.value;
    form.binding["lagrangian"] = hamiltonian.lagrangian.value_or(
        graph.subtract(contraction(graph, hamiltonian.mu, hamiltonian.y), hamiltonian.value));
    for (std::size_t a = 0; a < hamiltonian.y.size(); ++a) {
        form.binding[model.fibre.coordinates[a].name] = hamiltonian.y[a];
        form.binding[model.fibre.momenta[a].name] = hamiltonian.mu[a];
    }
    for (const auto& [name, node] : system_names(model, system)) form.binding[name] = node;
}

void add_kernels(Graph& graph, const HamiltonianNodes& hamiltonian, NodeId power, const FormulationParts& parts,
                 Formulation& form)
{
    if (!hamiltonian.y.empty())
        form.kernels.push_back({"velocity",
                                KernelShape::vector,
                                column("y", hamiltonian.y),
                                {fmt::format("y^a = dH/dmu_a, shape ({}).", hamiltonian.y.size())},
                                {},
                                {}});
    form.kernels.push_back(scalar_kernel("energy", hamiltonian.value, "E = H(t, x, mu)."));
    if (!graph.is_zero(power))
        form.kernels.push_back(scalar_kernel("power", power, "dE/dt = Q_a y^a + dH/dt along the motion."));
    form.kernels.push_back(scalar_kernel("hamiltonian", hamiltonian.value, "H(t, x, mu)."));
    if (hamiltonian.lagrangian)
        form.kernels.push_back(scalar_kernel("lagrangian", *hamiltonian.lagrangian, "L at y = dH/dmu."));
    if (!parts.hessians) return;
    std::vector<NodeId> first = hamiltonian.dH_dx;
    first.insert(first.end(), hamiltonian.y.begin(), hamiltonian.y.end());
    form.kernels.push_back(hessian_kernel(graph, "hamiltonian_hessian", first, form, "d2H/ds2"));
}

} // namespace

Formulation hamilton_form(Graph& graph, const Model& model, const VerifiedAlgebroid& verified,
                          const FormulationParts& parts)
{
    if (!model.hamiltonian) {
        require_regular_lagrangian(model, verified.regularity, "Hamiltonian");
        require_legendre_transform(model, verified.regularity);
    }
    const SystemNodes system = system_nodes(graph, model, verified.algebroid);
    HamiltonianNodes start;
    for (const Symbol& symbol : model.fibre.momenta) start.mu.push_back(graph.input(symbol.name));
    const HamiltonianNodes hamiltonian = model.hamiltonian
                                             ? given_hamiltonian(graph, model, system, std::move(start))
                                             : legendre(graph, model, system, verified.regularity, std::move(start));
    Formulation form;
    form.form = "hamilton";
    form.time = system.time;
    form.parameters = system.parameters;
    form.x = system.x;
    form.lanes = hamiltonian.mu;
    form.lane_names = model.fibre.momenta;
    form.lane_group = "Momenta";
    form.implicit = hamiltonian.implicit;
    Lowering lower(graph);
    std::vector<NodeId> y_inputs;
    for (const Symbol& symbol : model.fibre.coordinates) y_inputs.push_back(graph.input(symbol.name));
    const std::vector<NodeId> forces =
        substitute(graph, generalized_forces(graph, lower, model, y_inputs), replacements(y_inputs, hamiltonian.y));
    if (parts.motion) {
        form.derivative = base_velocity(graph, system, hamiltonian.y);
        std::vector<NodeId> rate = along_anchor(graph, system, hamiltonian.dH_dx);
        for (std::size_t a = 0; a < rate.size(); ++a) rate[a] = graph.subtract(forces[a], rate[a]);
        subtract_brackets(graph, system, hamiltonian.mu, hamiltonian.y, rate);
        form.derivative.insert(form.derivative.end(), rate.begin(), rate.end());
        form.pivots = hamiltonian.pivots;
    }
    const bool forced = !model.forces.empty() || model.dissipation;
    form.documentation = {"Hamilton's equations, ds = (xdot, mudot): xdot^i = rho^i_a dH/dmu_a and",
                          forced ? "mudot_a = -(rho_a(H) + mu_c C^c_ab dH/dmu_b) + Q_a."
                                 : "mudot_a = -(rho_a(H) + mu_c C^c_ab dH/dmu_b).",
                          model.hamiltonian ? "H is given."
                                            : "H is the Legendre transform of L: y = dH/dmu solves mu_a = dL/dy^a.",
                          "s and ds may be the same object."};
    bind_names(model, system, hamiltonian, form, graph);
    const NodeId power = graph.add(contraction(graph, forces, hamiltonian.y), hamiltonian.dH_dt);
    add_kernels(graph, hamiltonian, power, parts, form);
    return form;
}

} // namespace lagen
