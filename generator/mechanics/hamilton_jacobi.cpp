// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/hamilton_jacobi.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

HamiltonJacobiNodes hamilton_jacobi(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                                    const std::vector<NodeId>& alpha)
{
    const Algebroid& algebroid = system.algebroid;
    const std::size_t r = system.r();
    ExteriorForm form{1, {}};
    for (std::size_t a = 0; a < r; ++a)
        if (!graph.is_zero(alpha[a])) form.components.emplace(FormIndex{a}, alpha[a]);
    const auto at_alpha = [&](const std::vector<NodeId>& nodes) {
        return substitute(graph, nodes, replacements(hamiltonian.mu, alpha));
    };
    MomentumBalance balance = hamilton_balance(graph, system, hamiltonian);
    for (std::vector<NodeId>* each : {&balance.df_dx, &balance.p, &balance.y, &balance.forces}) *each = at_alpha(*each);

    BaseGradient partial(graph, algebroid.x);
    HamiltonJacobiNodes result;
    result.closed = differential(partial, algebroid, form);
    const std::vector<NodeId> mudot = momentum_rates(graph, algebroid, balance);
    const std::vector<std::pair<NodeId, NodeId>> motion =
        replacements(algebroid.x, base_velocity(graph, algebroid, balance.y));
    const std::vector<NodeId> along = directional(graph, alpha, motion);
    const NodeId H = at_alpha({hamiltonian.value})[0];
    if (system.lagrangian) {
        const NodeId L = substitute(graph, {&*system.lagrangian, 1}, replacements(algebroid.y, balance.y))[0];
        result.action = graph.subtract(contraction(graph, alpha, balance.y), graph.add(L, H));
    }
    for (std::size_t b = 0; b < r; ++b) {
        result.equation.push_back(partial.along(algebroid.anchor[b], H));
        result.lift.push_back(graph.subtract(along[b], mudot[b]));
    }
    return result;
}

} // namespace lagen
