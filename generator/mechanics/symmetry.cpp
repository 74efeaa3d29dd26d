// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/symmetry.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/discrete.hpp"

namespace lagen {

namespace {

/// p_a (y^b rho_b(s^a) + C^a_bd y^b s^d)
NodeId along_fibre(Graph& graph, const System& system, const std::vector<NodeId>& p, const std::vector<NodeId>& y,
                   const std::vector<NodeId>& s)
{
    const Algebroid& algebroid = system.algebroid;
    BaseGradient partial(graph, algebroid.x);
    std::vector<NodeId> terms;
    for (std::size_t b = 0; b < algebroid.r(); ++b)
        for (std::size_t a = 0; a < algebroid.r(); ++a) {
            const NodeId slope = partial.along(algebroid.anchor[b], s[a]);
            terms.push_back(graph.product(std::vector{p[a], y[b], slope}));
            for (const ColumnEntry& entry : algebroid.C(b, a)) // C^c_ba y^b s^a
                terms.push_back(graph.product(std::vector{p[entry.index], entry.value, y[b], s[a]}));
        }
    return graph.sum(terms);
}

/// s^a rho_a(f)
NodeId along_base(Graph& graph, const System& system, const std::vector<NodeId>& s, NodeId f)
{
    return contraction(graph, base_velocity(graph, system.algebroid, s), gradient(graph, f, system.algebroid.x));
}

} // namespace

NodeId lift_of_function(Graph& graph, const System& system, NodeId f, const std::vector<NodeId>& s)
{
    const std::vector<NodeId>& y = system.algebroid.y;
    return graph.add(along_base(graph, system, s, f), along_fibre(graph, system, gradient(graph, f, y), y, s));
}

NodeId lift_of_lagrangian(Graph& graph, const System& system, const LagrangianNodes& lagrangian,
                          const std::vector<NodeId>& s)
{
    return graph.add(along_base(graph, system, s, *system.lagrangian),
                     along_fibre(graph, system, lagrangian.fibre.momenta, system.algebroid.y, s));
}

NodeId lift_of_hamiltonian(Graph& graph, const System& system, const std::vector<NodeId>& s)
{
    const NodeId H = *system.hamiltonian;
    return graph.subtract(along_fibre(graph, system, system.mu, gradient(graph, H, system.mu), s),
                          along_base(graph, system, s, H));
}

NodeId lift_of_discrete_lagrangian(Graph& graph, const System& system, const std::vector<NodeId>& s)
{
    const Groupoid& groupoid = *system.groupoid;
    const DiscreteLegendre legendre = discrete_legendre(graph, groupoid, *system.discrete->lagrangian);
    const std::vector<NodeId> behind =
        substitute(graph, s, replacements(groupoid.arrow.x, target(graph, groupoid, groupoid.arrow)));
    return graph.subtract(contraction(graph, legendre.plus, behind), contraction(graph, legendre.minus, s));
}

} // namespace lagen
