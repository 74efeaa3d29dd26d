// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/hamilton_jacobi.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

HamiltonJacobiNodes hamilton_jacobi(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                                    const std::vector<NodeId>& alpha)
{
    const Algebroid& algebroid = system.algebroid;
    const std::size_t r = system.r(), n = system.n();
    ExteriorForm form{1, {}};
    for (std::size_t a = 0; a < r; ++a)
        if (!graph.is_zero(alpha[a])) form.components.emplace(FormIndex{a}, alpha[a]);
    // Everything of H at mu = alpha(x): H, dH/dmu, dH/dx.
    std::vector<NodeId> nodes{hamiltonian.value};
    nodes.insert(nodes.end(), hamiltonian.y.begin(), hamiltonian.y.end());
    nodes.insert(nodes.end(), hamiltonian.dH_dx.begin(), hamiltonian.dH_dx.end());
    nodes = substitute(graph, nodes, replacements(hamiltonian.mu, alpha));
    const auto first = nodes.begin() + 1;
    const std::vector<NodeId> sigma(first, first + static_cast<std::ptrdiff_t>(r));
    const std::vector<NodeId> dH_dx(nodes.end() - static_cast<std::ptrdiff_t>(n), nodes.end());

    BaseGradient partial(graph, algebroid.x);
    HamiltonJacobiNodes result;
    result.closed = differential(partial, algebroid, form);
    MomentumBalance balance;
    for (const NodeId slope : dH_dx) balance.df_dx.push_back(graph.negate(slope));
    balance.p = alpha;
    balance.y = sigma;
    balance.forces = substitute(graph, system.forces_or_zero(graph), replacements(algebroid.y, sigma));
    const std::vector<NodeId> mudot = momentum_rates(graph, algebroid, balance);
    const std::vector<std::pair<NodeId, NodeId>> motion =
        replacements(algebroid.x, base_velocity(graph, algebroid, sigma));
    const std::vector<NodeId> along = directional(graph, alpha, motion);
    for (std::size_t b = 0; b < r; ++b) {
        result.equation.push_back(partial.along(algebroid.anchor[b], nodes[0]));
        result.lift.push_back(graph.subtract(along[b], mudot[b]));
    }
    return result;
}

} // namespace lagen
