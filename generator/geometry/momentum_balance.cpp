// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/momentum_balance.hpp"

#include "graph/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// p_c C^c_ab
NodeId momentum_of_bracket(Graph& graph, const LoweredAlgebroid& algebroid, const std::vector<NodeId>& p, std::size_t a,
                           std::size_t b)
{
    std::vector<NodeId> terms;
    for (const ColumnEntry& entry : algebroid.C(a, b)) terms.push_back(graph.multiply(p[entry.index], entry.value));
    return graph.sum(terms);
}

} // namespace

std::vector<NodeId> base_velocity(Graph& graph, const LoweredAlgebroid& algebroid, const std::vector<NodeId>& y)
{
    std::vector<std::vector<NodeId>> terms(algebroid.x.size());
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (const ColumnEntry& entry : algebroid.anchor[a])
            terms[entry.index].push_back(graph.multiply(entry.value, y[a]));
    std::vector<NodeId> xdot;
    for (const std::vector<NodeId>& sum : terms) xdot.push_back(graph.sum(sum));
    return xdot;
}

NodeId momentum_rate(Graph& graph, const LoweredAlgebroid& algebroid, const MomentumBalance& balance,
                     BaseGradient& partial, std::size_t a)
{
    std::vector<NodeId> terms;
    partial.append_anchor_derivative(terms, algebroid.anchor[a], balance.potential, false);
    for (std::size_t b = 0; b < algebroid.r(); ++b) {
        const NodeId bracket = momentum_of_bracket(graph, algebroid, balance.p, a, b);
        if (!graph.is_zero(bracket)) terms.push_back(graph.negate(graph.multiply(bracket, balance.y[b])));
    }
    if (!graph.is_zero(balance.forces[a])) terms.push_back(balance.forces[a]);
    return graph.sum(terms);
}

NodeId energy_rate(Graph& graph, const LoweredAlgebroid& algebroid, const MomentumBalance& balance,
                   std::optional<NodeId> time)
{
    std::vector<NodeId> terms;
    if (time) {
        const NodeId inputs[] = {*time};
        terms.push_back(graph.negate(gradient(graph, balance.potential, inputs)[0]));
    }
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        if (!graph.is_zero(balance.forces[a])) terms.push_back(graph.multiply(balance.forces[a], balance.y[a]));
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = a; b < algebroid.r(); ++b)
            for (std::size_t c = 0; c < algebroid.r(); ++c) {
                const NodeId forward = LoweredAlgebroid::entry(graph, algebroid.C(a, b), c);
                const NodeId backward =
                    a == b ? graph.constant(0) : LoweredAlgebroid::entry(graph, algebroid.C(b, a), c);
                const NodeId coefficient = graph.add(forward, backward);
                const NodeId factors[] = {balance.p[c], coefficient, balance.y[a], balance.y[b]};
                if (!graph.is_zero(coefficient)) terms.push_back(graph.negate(graph.product(factors)));
            }
    return graph.sum(terms);
}

std::vector<NodeId> generalized_forces(Graph& graph, Lowering& lower, const Model& model, const std::vector<NodeId>& y)
{
    std::vector<NodeId> forces(y.size(), graph.constant(0));
    for (const ComponentEntry& entry : model.forces)
        forces[entry.section] = graph.add(forces[entry.section], lower(entry.value));
    if (!model.dissipation) return forces;
    const std::vector<NodeId> dR_dy = gradient(graph, lower(model.dissipation), y);
    for (std::size_t a = 0; a < y.size(); ++a) forces[a] = graph.subtract(forces[a], dR_dy[a]);
    return forces;
}

void bind_undeclared(Binding& binding, const Model& model, const std::string& name, NodeId node)
{
    const std::vector<std::string> names = symbol_names(model);
    if (std::ranges::find(names, name) == names.end()) binding.emplace(name, node);
}

} // namespace lagen
