// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/variations.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

std::vector<NodeId> constant_bracket(Graph& graph, const Algebroid& algebroid, const std::vector<NodeId>& s,
                                     const std::vector<NodeId>& t)
{
    std::vector<NodeId> out(algebroid.r(), graph.constant(0));
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = 0; b < algebroid.r(); ++b)
            for (const ColumnEntry& C : algebroid.C(a, b)) {
                const NodeId factors[] = {C.value, s[a], t[b]};
                out[C.index] = graph.add(out[C.index], graph.product(factors));
            }
    return out;
}

Variation variation(Graph& graph, const Algebroid& algebroid, const std::vector<NodeId>& s,
                    const std::vector<NodeId>& sdot)
{
    Variation delta{base_velocity(graph, algebroid, s), constant_bracket(graph, algebroid, algebroid.y, s)};
    for (std::size_t a = 0; a < algebroid.r(); ++a) delta.y[a] = graph.add(sdot[a], delta.y[a]);
    return delta;
}

std::vector<NodeId> varied(Graph& graph, const Algebroid& algebroid, const Variation& delta, std::span<const NodeId> f,
                           const Replacements& more)
{
    Replacements seeds = replacements(algebroid.x, delta.x);
    const Replacements fibre = replacements(algebroid.y, delta.y);
    seeds.insert(seeds.end(), fibre.begin(), fibre.end());
    seeds.insert(seeds.end(), more.begin(), more.end());
    return directional(graph, f, seeds);
}

NodeId varied(Graph& graph, const Algebroid& algebroid, const Variation& delta, NodeId f, const Replacements& more)
{
    return varied(graph, algebroid, delta, {&f, 1}, more)[0];
}

ActionVariations action_variations(Graph& graph, const System& system, const Variation& delta,
                                   const std::vector<NodeId>& s)
{
    const Algebroid& algebroid = system.algebroid;
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    const MomentumBalance balance = lagrange_balance(graph, system, lagrangian);
    ActionVariations out;
    out.p = lagrangian.fibre.momenta;
    out.pushes = momentum_rates(graph, algebroid, balance);
    out.base = contraction(graph, lagrangian.dL_dx, base_velocity(graph, algebroid, s));
    out.fibre = contraction(graph, out.p, delta.y);
    out.second = varied(graph, algebroid, delta, varied(graph, algebroid, delta, *system.lagrangian));
    return out;
}

std::vector<NodeId> terms_of_first_variation(Graph& graph, const System& system, const std::vector<NodeId>& s,
                                             const std::vector<NodeId>& sdot)
{
    const Algebroid& algebroid = system.algebroid;
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    const std::vector<NodeId>& p = lagrangian.fibre.momenta;
    const std::vector<NodeId> turned = constant_bracket(graph, algebroid, algebroid.y, s);
    std::vector<NodeId> terms;
    for (std::size_t a = 0; a < algebroid.r(); ++a) {
        std::vector<NodeId> alone(algebroid.r(), graph.constant(0));
        alone[a] = s[a];
        terms.push_back(contraction(graph, lagrangian.dL_dx, base_velocity(graph, algebroid, alone)));
    }
    for (std::size_t a = 0; a < algebroid.r(); ++a) terms.push_back(graph.multiply(p[a], sdot[a]));
    for (std::size_t a = 0; a < algebroid.r(); ++a) terms.push_back(graph.multiply(p[a], turned[a]));
    return terms;
}

std::string jacobi_rate_name(const std::string& state)
{
    return "d/dt " + state;
}

std::vector<NodeId> jacobi_rates(Graph& graph, const System& system, std::span<const NodeId> ydot)
{
    const JacobiField& field = *system.jacobi_field;
    const Variation delta{base_velocity(graph, system.algebroid, field.sigma), field.delta};
    return varied(graph, system.algebroid, delta, ydot);
}

} // namespace lagen
