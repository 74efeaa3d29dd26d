// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/lagrange.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

LagrangianNodes lagrangian_nodes(Graph& graph, const System& system)
{
    LagrangianNodes nodes;
    nodes.fibre = fibre_hessian(graph, *system.lagrangian, system.algebroid.y);
    BaseSlopes slopes = base_slopes(graph, system, *system.lagrangian);
    nodes.dL_dx = std::move(slopes.x);
    nodes.dL_dt = slopes.t;
    nodes.energy = graph.subtract(contraction(graph, system.algebroid.y, nodes.fibre.momenta), *system.lagrangian);
    return nodes;
}

MomentumBalance lagrange_balance(Graph& graph, const System& system, const LagrangianNodes& lagrangian)
{
    return {lagrangian.dL_dx, lagrangian.dL_dt, lagrangian.fibre.momenta, system.algebroid.y,
            system.forces_or_zero(graph)};
}

std::vector<NodeId> acceleration_forces(Graph& graph, const System& system, const LagrangianNodes& lagrangian,
                                        const std::vector<NodeId>& pdot)
{
    std::vector<std::pair<NodeId, NodeId>> seeds =
        replacements(system.algebroid.x, base_velocity(graph, system.algebroid, system.algebroid.y));
    seeds.emplace_back(system.time, graph.constant(1));
    const std::vector<NodeId> drift = directional(graph, lagrangian.fibre.momenta, seeds);
    std::vector<NodeId> right;
    for (std::size_t a = 0; a < pdot.size(); ++a) right.push_back(graph.subtract(pdot[a], drift[a]));
    return right;
}

} // namespace lagen
