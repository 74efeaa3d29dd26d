// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton's equations (mechanics/hamilton.hpp) as kernels, of H as it is given or by Legendre's transform of L.
#include "graph/calculus/differentiate.hpp"
#include "kernels/formulation.hpp"
#include "mechanics/hamilton.hpp"
#include "verify/legendre_obstacle.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

HamiltonianNodes hamiltonian_nodes(Graph& graph, const System& system, const Regularity& regularity)
{
    if (system.hamiltonian) return given_hamiltonian(graph, system);
    require_regular_lagrangian(system, regularity, "Hamiltonian");
    require_legendre_transform(system.name, regularity);
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    graph.remember_hessian(lagrangian.fibre.hessian, lagrangian.fibre.y, lagrangian.fibre.lagrangian);
    return legendre_transform(graph, system, lagrangian, mass_structure(regularity), regularity.newton_start);
}

void add_kernels(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian, NodeId power, bool hessians,
                 Formulation& form)
{
    if (!hamiltonian.y.empty()) form.kernels.push_back(table_kernel(form, "velocity", column("y", hamiltonian.y)));
    const bool has_drift = hamiltonian.constrained && hamiltonian.constrained->hull.has_drift();
    form.kernels.push_back(scalar_kernel(
        form, "energy", has_drift ? constrained_energy(graph, *hamiltonian.constrained) : hamiltonian.value));
    if (!has_drift && !graph.is_zero(power)) form.kernels.push_back(scalar_kernel(form, "power", power));
    form.kernels.push_back(scalar_kernel(form, "hamiltonian", hamiltonian.value));
    if (system.lagrangian) form.kernels.push_back(scalar_kernel(form, "lagrangian", hamiltonian.lagrangian));
    if (!hessians) return;
    std::vector<NodeId> first = hamiltonian.dH_dx;
    first.insert(first.end(), hamiltonian.y.begin(), hamiltonian.y.end());
    first.resize(state_of(form).size(), graph.constant(0)); // H does not depend on first-order states
    form.kernels.push_back(hessian_kernel(graph, form, "hamiltonian_hessian", first));
}

/// |p - v| < |v| / proved_value_parts for each parameter p that y(x, mu) is proved to be unique for at the value v
/// alone.
void require_proved_values(Graph& graph, const Regularity& regularity, Formulation& form)
{
    const NodeId relative = graph.constant(Rational(1, proved_value_parts));
    for (const auto& [p, value] : regularity.legendre_values) {
        const NodeId size = graph.is_zero(value) ? graph.constant(1) : graph.apply(Op::abs, value);
        const NodeId distance = graph.apply(Op::abs, graph.subtract(p, value));
        form.parameter_conditions.emplace_back(fmt::format("{} == {}", graph.input_name(p), to_text(graph, value)),
                                               graph.subtract(graph.multiply(relative, size), distance));
    }
}

} // namespace

Formulation hamilton_form(Graph& graph, const System& system, const Report& report, const FormulationRequest& request)
{
    const HamiltonianNodes hamiltonian = hamiltonian_nodes(graph, system, report.mechanics.regularity);
    const PhaseSystem phase = hamilton_system(graph, system, hamiltonian);
    Formulation form = empty_form(system, FormKind::hamilton, system.mu, request);
    form.implicit = hamiltonian.implicit;
    if (!system.hamiltonian) require_proved_values(graph, report.mechanics.regularity, form);
    set_motion(graph, system, phase, form);
    if (!hamiltonian.matrix.empty()) form.pivots = single_blocks(graph, hamiltonian.matrix, system.mu.size());
    form.documentation = {"Hamilton's equations, ds = (xdot, mudot): xdot^i = rho^i_a dH/dmu_a and",
                          system.forces.empty() ? "mudot_a = -(rho_a(H) + mu_c C^c_ab dH/dmu_b)."
                                                : "mudot_a = -(rho_a(H) + mu_c C^c_ab dH/dmu_b) + Q_a.",
                          system.hamiltonian ? "H is given."
                                             : "H is the Legendre transform of L: y = dH/dmu solves mu_a = dL/dy^a.",
                          "s and ds may be the same object."};
    add_minor(graph, system, form);
    if (hamiltonian.constrained)
        form.documentation = {"The almost-Hamiltonian equations on D*, ds = (xdot, mudot): xdot = rho(Y) and",
                              "mudot_a = -rho(e_a)(h) - P_c [e_a, Y]^c + Q_a, Y = b + (dh/dmu_a) e_a; h is the",
                              "Legendre transform of L on the constraint. s and ds may be the same object."};
    add_kernels(graph, system, hamiltonian, phase.energy_rate, request.hessians, form);
    if (hamiltonian.constrained) add_constrained(graph, system, *hamiltonian.constrained, form);
    form.hamiltonian = hamiltonian;
    return form;
}

} // namespace lagen
