// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/hamilton.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

HamiltonianNodes given_hamiltonian(Graph& graph, const System& system)
{
    HamiltonianNodes nodes;
    nodes.value = *system.hamiltonian;
    nodes.mu = system.mu;
    std::vector<NodeId> variables = system.mu;
    variables.insert(variables.end(), system.algebroid.x.begin(), system.algebroid.x.end());
    variables.push_back(system.time);
    const std::vector<NodeId> slopes = gradient(graph, nodes.value, variables);
    const auto first_x = slopes.begin() + static_cast<std::ptrdiff_t>(system.mu.size());
    nodes.y.assign(slopes.begin(), first_x);
    nodes.dH_dx.assign(first_x, slopes.end() - 1);
    nodes.dH_dt = slopes.back();
    nodes.lagrangian = graph.subtract(contraction(graph, nodes.mu, nodes.y), nodes.value);
    return nodes;
}

HamiltonianNodes legendre_transform(Graph& graph, const System& system, const LagrangianNodes& lagrangian,
                                    MatrixStructure structure, std::span<const Rational> start)
{
    const std::vector<NodeId>& y = lagrangian.fibre.y;
    HamiltonianNodes nodes;
    nodes.mu = system.mu;
    FibreHessian fibre = lagrangian.fibre;
    const auto offset = affine_offset(graph, fibre);
    std::vector<NodeId> at_velocity = lagrangian.dL_dx;
    at_velocity.push_back(lagrangian.dL_dt);
    at_velocity.push_back(lagrangian.fibre.lagrangian);
    // Of a momentum that is affine in y the root may lie where L is not defined: what must be positive has cancelled.
    if (!offset || !positive_operands(graph, lagrangian.fibre.lagrangian, y).empty()) {
        std::vector<NodeId> residuals;
        for (std::size_t a = 0; a < y.size(); ++a) residuals.push_back(graph.subtract(fibre.momenta[a], nodes.mu[a]));
        nodes.implicit.push_back(gradient_block(graph, "velocity", "y with dL/dy^a = mu_a (the Legendre transform).", y,
                                                residuals, lagrangian.fibre.lagrangian, start));
        nodes.implicit.back().structure = structure;
        nodes.y = y;
    } else {
        std::vector<NodeId> right;
        for (std::size_t a = 0; a < y.size(); ++a) right.push_back(graph.subtract(nodes.mu[a], (*offset)[a]));
        nodes.y = graph.solve(fibre.hessian, right, structure);
        nodes.matrix = std::move(fibre.hessian);
        at_velocity = substitute(graph, at_velocity, replacements(y, nodes.y));
    }
    if (lagrangian.constrained)
        nodes.constrained = at_velocities(graph, *lagrangian.constrained, replacements(y, nodes.y));
    nodes.lagrangian = at_velocity.back();
    nodes.dH_dt = graph.negate(at_velocity[at_velocity.size() - 2]);
    for (std::size_t i = 0; i < system.n(); ++i) nodes.dH_dx.push_back(graph.negate(at_velocity[i]));
    nodes.value = graph.subtract(contraction(graph, nodes.mu, nodes.y), nodes.lagrangian);
    return nodes;
}

namespace {

/// mudot_alpha = -rho_alpha(h) - P_a [e_alpha, b + (dh/dmu_beta) e_beta]^a + Q_alpha on D*
PhaseSystem constrained_phase(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                              const MomentumBalance& balance)
{
    const ConstrainedNodes& nodes = *hamiltonian.constrained;
    const Algebroid& frame = nodes.hull.frame;
    PhaseSystem phase;
    phase.hamiltonian = hamiltonian.value;
    phase.lagrangian = hamiltonian.lagrangian;
    phase.mu = hamiltonian.mu;
    phase.y = hamiltonian.y;
    phase.xdot = base_velocity(graph, frame, balance.y);
    phase.mudot = constrained_rates(graph, system, nodes, momentum_rates(graph, frame, balance));
    phase.energy_rate = moving_energy_rate(graph, system, nodes, balance);
    phase.more = ambient_names(system, nodes.hull.Y);
    if (!system.declares("energy")) phase.more.emplace("energy", constrained_energy(graph, nodes));
    if (!system.declares("moving_energy")) phase.more.emplace("moving_energy", hamiltonian.value);
    return phase;
}

} // namespace

std::optional<HamiltonianNodes> closed_hamiltonian(Graph& graph, const System& system, std::span<const Rational> start)
{
    if (system.hamiltonian) return given_hamiltonian(graph, system);
    if (!system.lagrangian) return std::nullopt;
    HamiltonianNodes nodes =
        legendre_transform(graph, system, lagrangian_nodes(graph, system), MatrixStructure::symmetric, start);
    if (!nodes.implicit.empty()) return std::nullopt;
    return nodes;
}

MomentumBalance hamilton_balance(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian)
{
    MomentumBalance balance;
    for (const NodeId slope : hamiltonian.dH_dx) balance.df_dx.push_back(graph.negate(slope));
    if (hamiltonian.constrained)
        return constrained_balance(graph, *hamiltonian.constrained, std::move(balance.df_dx),
                                   graph.negate(hamiltonian.dH_dt));
    balance.df_dt = graph.negate(hamiltonian.dH_dt);
    balance.p = hamiltonian.mu;
    balance.y = hamiltonian.y;
    balance.forces = substitute(graph, system.forces_or_zero(graph), replacements(system.algebroid.y, hamiltonian.y));
    return balance;
}

PhaseSystem hamilton_system(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian)
{
    const MomentumBalance balance = hamilton_balance(graph, system, hamiltonian);
    if (hamiltonian.constrained) return constrained_phase(graph, system, hamiltonian, balance);
    return phase_system(graph, system, balance, hamiltonian.value, hamiltonian.lagrangian);
}

} // namespace lagen
