// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/nonholonomic.hpp"

#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {

namespace {

/// The sections with their anchors and brackets; [s, t] is the negative of [t, s], entry by entry.
Algebroid frame_of(Graph& graph, const Algebroid& algebroid, const std::vector<Section>& sections)
{
    const std::size_t m = sections.size();
    Algebroid frame;
    frame.x = algebroid.x;
    frame.bracket.resize(m * m);
    frame.given.assign(m * m, false);
    BaseGradient partial(graph, algebroid.x);
    for (std::size_t a = 0; a < m; ++a) {
        frame.anchor.push_back(anchor_of(graph, algebroid, sections[a]));
        for (std::size_t b = a + 1; b < m; ++b) {
            Column& forth = frame.bracket[a * m + b];
            forth = bracket(partial, algebroid, sections[a], sections[b]);
            std::erase_if(forth, [&](const ColumnEntry& entry) { return graph.is_zero(entry.value); });
            for (const ColumnEntry& entry : forth)
                frame.bracket[b * m + a].push_back({entry.index, graph.negate(entry.value)});
            frame.given[a * m + b] = true;
        }
    }
    return frame;
}

/// f_a ds^a/dt at fixed x
NodeId along_rate(Graph& graph, NodeId time, const std::vector<NodeId>& f, const Section& s)
{
    Section rate;
    for (const ColumnEntry& entry : s)
        rate.push_back({entry.index, gradient(graph, entry.value, std::vector{time})[0]});
    return pairing(graph, f, rate);
}

} // namespace

ConstraintHull constraint_hull(Graph& graph, const System& system)
{
    const Distribution& distribution = *system.distribution;
    ConstraintHull hull;
    hull.sections = distribution.sections;
    hull.weights = distribution.y;
    hull.k = hull.sections.size();
    if (!distribution.drift.empty()) {
        hull.sections.push_back(distribution.drift);
        hull.weights.push_back(graph.constant(1));
    }
    hull.frame = frame_of(graph, system.algebroid, hull.sections);
    hull.frame.y = hull.weights;
    hull.Y.assign(system.r(), graph.constant(0));
    for (std::size_t alpha = 0; alpha < hull.sections.size(); ++alpha)
        for (const ColumnEntry& entry : hull.sections[alpha])
            hull.Y[entry.index] = graph.add(hull.Y[entry.index], graph.multiply(entry.value, hull.weights[alpha]));
    return hull;
}

ConstrainedNodes constrained_nodes(Graph& graph, const System& system)
{
    ConstrainedNodes nodes;
    nodes.hull = constraint_hull(graph, system);
    const NodeId L = *system.lagrangian;
    const BaseSlopes slopes = base_slopes(graph, system, L);
    std::vector<NodeId> outputs{L, slopes.t};
    const std::vector<NodeId> P = gradient(graph, L, system.algebroid.y);
    for (const std::vector<NodeId>& more : {P, slopes.x, system.forces_or_zero(graph)})
        outputs.insert(outputs.end(), more.begin(), more.end());
    const std::vector<NodeId> there = substitute(graph, outputs, replacements(system.algebroid.y, nodes.hull.Y));
    nodes.lagrangian = there[0];
    nodes.dL_dt = there[1];
    auto next = there.begin() + 2;
    const auto take = [&](std::size_t count) {
        const auto first = next;
        next += static_cast<std::ptrdiff_t>(count);
        return std::vector<NodeId>(first, next);
    };
    nodes.P = take(system.r());
    nodes.dL_dx = take(system.n());
    nodes.forces = take(system.r());
    return nodes;
}

ConstrainedNodes at_velocities(Graph& graph, ConstrainedNodes nodes, const Replacements& y)
{
    for (std::vector<NodeId>* each : {&nodes.hull.weights, &nodes.hull.Y, &nodes.P, &nodes.dL_dx, &nodes.forces})
        *each = substitute(graph, *each, y);
    const NodeId scalars[] = {nodes.lagrangian, nodes.dL_dt};
    const std::vector<NodeId> there = substitute(graph, scalars, y);
    nodes.lagrangian = there[0];
    nodes.dL_dt = there[1];
    return nodes;
}

NodeId constrained_energy(Graph& graph, const ConstrainedNodes& nodes)
{
    return graph.subtract(contraction(graph, nodes.hull.Y, nodes.P), nodes.lagrangian);
}

MomentumBalance constrained_balance(Graph& graph, const ConstrainedNodes& nodes, std::vector<NodeId> dl_dx,
                                    NodeId dl_dt)
{
    MomentumBalance balance{std::move(dl_dx), dl_dt, nodes.P, nodes.hull.weights, {}};
    for (const Section& section : nodes.hull.sections) balance.forces.push_back(pairing(graph, nodes.forces, section));
    return balance;
}

std::vector<NodeId> constrained_rates(Graph& graph, const System& system, const ConstrainedNodes& nodes,
                                      const std::vector<NodeId>& hull_rates)
{
    std::vector<NodeId> rates;
    for (std::size_t alpha = 0; alpha < nodes.hull.k; ++alpha)
        rates.push_back(
            graph.add(hull_rates[alpha], along_rate(graph, system.time, nodes.P, nodes.hull.sections[alpha])));
    return rates;
}

NodeId moving_energy(Graph& graph, const ConstrainedNodes& nodes)
{
    const NodeId energy = constrained_energy(graph, nodes);
    if (!nodes.hull.has_drift()) return energy;
    return graph.subtract(energy, pairing(graph, nodes.P, nodes.hull.sections.back()));
}

NodeId moving_energy_rate(Graph& graph, const System& system, const ConstrainedNodes& nodes,
                          const MomentumBalance& balance)
{
    const ConstraintHull& hull = nodes.hull;
    NodeId rate = graph.negate(nodes.dL_dt);
    for (std::size_t alpha = 0; alpha < hull.k; ++alpha)
        rate = graph.add(rate, graph.multiply(balance.forces[alpha], hull.weights[alpha]));
    if (!hull.has_drift()) return rate;
    const NodeId with_force = momentum_rates(graph, hull.frame, balance).back();
    const NodeId lift = graph.subtract(with_force, balance.forces.back());
    return graph.subtract(graph.subtract(rate, lift), along_rate(graph, system.time, nodes.P, hull.sections.back()));
}

std::vector<NodeId> reaction(Graph& graph, const System& system, const ConstrainedNodes& nodes,
                             const Replacements& rates)
{
    const MomentumBalance ambient{nodes.dL_dx, nodes.dL_dt, nodes.P, nodes.hull.Y, nodes.forces};
    const std::vector<NodeId> free = momentum_rates(graph, system.algebroid, ambient);
    const std::vector<NodeId> constrained = directional(graph, nodes.P, rates);
    std::vector<NodeId> lambda;
    for (std::size_t a = 0; a < free.size(); ++a) lambda.push_back(graph.subtract(constrained[a], free[a]));
    return lambda;
}

NodeId almost_poisson_bracket(Graph& graph, const System& system, const ConstrainedNodes& nodes, NodeId F, NodeId G)
{
    BaseGradient partial(graph, system.algebroid.x);
    const std::vector<NodeId> F_p = gradient(graph, F, system.mu), G_p = gradient(graph, G, system.mu);
    const ConstraintHull& hull = nodes.hull;
    std::vector<NodeId> terms;
    for (std::size_t alpha = 0; alpha < hull.k; ++alpha) {
        const VectorField& rho = hull.frame.anchor[alpha];
        terms.push_back(graph.multiply(F_p[alpha], partial.along(rho, G)));
        terms.push_back(graph.negate(graph.multiply(G_p[alpha], partial.along(rho, F))));
        for (std::size_t beta = 0; beta < hull.k; ++beta) {
            const NodeId factors[] = {pairing(graph, nodes.P, hull.frame.C(alpha, beta)), F_p[alpha], G_p[beta]};
            terms.push_back(graph.product(factors));
        }
    }
    return graph.sum(terms);
}

Binding ambient_names(const System& system, const std::vector<NodeId>& Y)
{
    Binding binding;
    const std::vector<NodeId>& y = system.velocities();
    for (std::size_t a = 0; a < Y.size(); ++a) {
        const NodeId input = system.algebroid.y[a];
        if (std::ranges::find(y, input) == y.end()) binding.emplace(system.graph.input_name(input), Y[a]);
    }
    return binding;
}

} // namespace lagen
