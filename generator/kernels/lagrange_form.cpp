// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations (mechanics/lagrange.hpp) as kernels: ydot = W^-1 (..), never an inverse by symbols.
#include "graph/calculus/differentiate.hpp"
#include "kernels/formulation.hpp"
#include "mechanics/lagrange.hpp"
#include "mechanics/variations.hpp"
#include "proof/rank.hpp"
#include "verify/proof_setting.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

// Inverse dynamics: the inputs u that give accelerations ydot. Of Lagrange's equations W ydot = f(u) with f affine in
// u
//   (df/du) u = W ydot - f(0),   df/du of shape (r, r).

/// df/du by rows, where it is square, free of u and has an inverse.
std::optional<std::vector<NodeId>> slope_by_inputs(Graph& graph, const System& system, const std::vector<NodeId>& force)
{
    const std::size_t r = force.size();
    if (r == 0 || system.inputs.size() != r) return std::nullopt;
    const std::vector<NodeId> slope = joined_rows(jacobian(graph, force, system.inputs));
    if (depends_on_any(graph, slope, system.inputs)) return std::nullopt;
    const auto decider = ZeroDecider::make(graph, proof_setting(graph, system));
    if (!decider || !generic_rank(graph, slope, r, r, *decider).surjective) return std::nullopt;
    return slope;
}

/// Adds the kernel `inverse_dynamics` to Lagrange's form, whose W is `mass_matrix` and f `force`, where accelerations
/// determine the inputs: there are as many of both, f is affine in u, and df/du is proved to have an inverse at almost
/// every point.
void add_inverse_dynamics(Graph& graph, const System& system, const std::vector<NodeId>& mass_matrix,
                          const std::vector<NodeId>& force, Formulation& form)
{
    const std::optional<std::vector<NodeId>> slope = slope_by_inputs(graph, system, force);
    if (!slope) return;
    const std::size_t r = force.size();
    const std::vector<NodeId> zeros(r, graph.constant(0));
    std::vector<NodeId> right = substitute(graph, force, replacements(system.inputs, zeros));
    KernelInput rates{"ydot", ArrayRole::value, {1, r, 1}, {}};
    for (const NodeId lane : form.lanes) {
        const std::string& name = graph.input_name(lane);
        rates.entries.push_back({name + "_dot", {}, {}, graph.input("rate of " + name)});
    }
    for (std::size_t a = 0; a < r; ++a) {
        right[a] = graph.negate(right[a]);
        for (std::size_t b = 0; b < r; ++b)
            right[a] = graph.add(right[a], graph.multiply(mass_matrix[a * r + b], rates.entries[b].input));
    }
    Kernel kernel =
        table_kernel(form, "inverse_dynamics", column("out", graph.solve(*slope, right, MatrixStructure::general)));
    kernel.inputs = {std::move(rates)};
    kernel.checks->pivots = single_blocks(graph, *slope, r);
    kernel.checks->failures = "Answers singular_mass_matrix where dQ/du has no inverse at this state.";
    form.kernels.push_back(std::move(kernel));
}

void bind_names(Graph& graph, const System& system, const LagrangianNodes& lagrangian, Formulation& form)
{
    form.binding["energy"] = form.binding["hamiltonian"] = lagrangian.energy;
    if (lagrangian.constrained) {
        form.binding["hamiltonian"] = form.binding["moving_energy"] = moving_energy(graph, *lagrangian.constrained);
        form.binding.merge(ambient_names(system, lagrangian.constrained->hull.Y));
    }
    form.binding["lagrangian"] = lagrangian.fibre.lagrangian;
    for (std::size_t a = 0; a < system.mu.size(); ++a)
        form.binding[system.graph.input_name(system.mu[a])] = lagrangian.fibre.momenta[a];
    bind_system(graph, system, form);
    for (const NodeId y : system.velocities()) form.binding[system.graph.input_name(y)] = y;
}

void bind_jacobi_field(Graph& graph, const System& system, std::span<const NodeId> ydot, Formulation& form)
{
    if (!system.jacobi_field) return;
    const std::vector<NodeId> rates = jacobi_rates(graph, system, ydot);
    for (std::size_t a = 0; a < rates.size(); ++a)
        form.binding[jacobi_rate_name(graph.input_name(system.jacobi_field->delta[a]))] = rates[a];
}

void add_kernels(Graph& graph, const LagrangianNodes& lagrangian, std::optional<NodeId> power, bool hessians,
                 Formulation& form)
{
    const std::size_t r = lagrangian.fibre.y.size();
    if (r > 0) {
        form.kernels.push_back(table_kernel(form, "mass_matrix", matrix(graph, "W", r, r, lagrangian.fibre.hessian)));
        form.kernels.push_back(table_kernel(form, "momentum", column("p", lagrangian.fibre.momenta)));
    }
    form.kernels.push_back(scalar_kernel(form, "energy", lagrangian.energy));
    if (power && !graph.is_zero(*power)) form.kernels.push_back(scalar_kernel(form, "power", *power));
    form.kernels.push_back(scalar_kernel(form, "lagrangian", lagrangian.fibre.lagrangian));
    if (!hessians) return;
    const std::vector<NodeId> first = gradient(graph, lagrangian.fibre.lagrangian, state_of(form));
    form.kernels.push_back(hessian_kernel(graph, form, "lagrangian_hessian", first));
}

std::vector<std::string> documentation_of(const System& system)
{
    if (system.distribution)
        return {"The equations of motion, ds = (xdot, ydot), of a motion Y = b + y^a e_a: xdot = rho(Y) and",
                "d/dt p_a = rho(e_a)(L) - P_c [e_a, Y]^c + Q_a with p_a = W_ab y^b + .. and P = dL/dY.",
                "s and ds may be the same object."};
    return {"The equations of motion, ds = (xdot, ydot): xdot^i = rho^i_a y^a and",
            system.forces.empty()
                ? "W_ab ydot^b = rho_a(L) - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b."
                : "W_ab ydot^b = rho_a(L) + Q_a - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b.",
            "s and ds may be the same object."};
}

} // namespace

Formulation lagrange_form(Graph& graph, const System& system, const Report& report, const FormulationRequest& request)
{
    require_regular_lagrangian(system, report.mechanics.regularity, "Lagrangian");
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    const std::vector<NodeId>& W = lagrangian.fibre.hessian;
    graph.remember_hessian(W, lagrangian.fibre.y, lagrangian.fibre.lagrangian);
    const MomentumBalance balance = lagrange_balance(graph, system, lagrangian);
    Formulation form = empty_form(system, FormKind::lagrange, lagrangian.fibre.y, request);
    const LagrangeRates rates = lagrange_rates(graph, system, lagrangian, balance);
    form.derivative = rates.xdot;
    const std::vector<NodeId> ydot = graph.solve(W, rates.force, mass_structure(report.mechanics.regularity));
    form.derivative.insert(form.derivative.end(), ydot.begin(), ydot.end());
    form.pivots = single_blocks(graph, W, lagrangian.fibre.y.size());
    add_minor(graph, system, form);
    form.documentation = documentation_of(system);
    form.failures = "Answers singular_mass_matrix where W has no inverse at this state.";
    bind_names(graph, system, lagrangian, form);
    bind_jacobi_field(graph, system, ydot, form);
    append_state_rates(graph, system, form);
    add_kernels(graph, lagrangian, lagrange_power(graph, system, lagrangian, balance), request.hessians, form);
    if (request.inverse_dynamics) add_inverse_dynamics(graph, system, W, rates.force, form);
    if (lagrangian.constrained) add_constrained(graph, system, *lagrangian.constrained, form);
    return form;
}

} // namespace lagen
