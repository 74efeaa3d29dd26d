// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/lagrange.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

LagrangianNodes lagrangian_nodes(Graph& graph, const System& system)
{
    LagrangianNodes nodes;
    if (system.distribution) nodes.constrained = constrained_nodes(graph, system);
    const NodeId lagrangian = nodes.constrained ? nodes.constrained->lagrangian : *system.lagrangian;
    nodes.fibre = fibre_hessian(graph, lagrangian, system.velocities());
    BaseSlopes slopes = base_slopes(graph, system, lagrangian);
    nodes.dL_dx = std::move(slopes.x);
    nodes.dL_dt = slopes.t;
    nodes.energy = nodes.constrained
                       ? constrained_energy(graph, *nodes.constrained)
                       : graph.subtract(contraction(graph, system.algebroid.y, nodes.fibre.momenta), lagrangian);
    return nodes;
}

MomentumBalance lagrange_balance(Graph& graph, const System& system, const LagrangianNodes& lagrangian)
{
    if (lagrangian.constrained)
        return constrained_balance(graph, *lagrangian.constrained, lagrangian.dL_dx, lagrangian.dL_dt);
    return {lagrangian.dL_dx, lagrangian.dL_dt, lagrangian.fibre.momenta, system.algebroid.y,
            system.forces_or_zero(graph)};
}

LagrangeRates lagrange_rates(Graph& graph, const System& system, const LagrangianNodes& lagrangian,
                             const MomentumBalance& balance)
{
    LagrangeRates rates;
    const Algebroid& frame = lagrangian.constrained ? lagrangian.constrained->hull.frame : system.algebroid;
    rates.xdot = base_velocity(graph, frame, balance.y);
    rates.pdot = momentum_rates(graph, frame, balance);
    if (lagrangian.constrained) rates.pdot = constrained_rates(graph, system, *lagrangian.constrained, rates.pdot);
    std::vector<std::pair<NodeId, NodeId>> seeds = replacements(system.algebroid.x, rates.xdot);
    seeds.emplace_back(system.time, graph.constant(1));
    const std::vector<NodeId> drift = directional(graph, lagrangian.fibre.momenta, seeds);
    for (std::size_t a = 0; a < rates.pdot.size(); ++a) rates.force.push_back(graph.subtract(rates.pdot[a], drift[a]));
    return rates;
}

std::optional<NodeId> lagrange_power(Graph& graph, const System& system, const LagrangianNodes& lagrangian,
                                     const MomentumBalance& balance)
{
    if (!lagrangian.constrained) return energy_rate(graph, system.algebroid, balance);
    if (lagrangian.constrained->hull.has_drift()) return std::nullopt;
    return moving_energy_rate(graph, system, *lagrangian.constrained, balance);
}

} // namespace lagen
