// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/self_adjoint.hpp"

#include "graph/calculus/differentiate.hpp"
#include "verify/arrow_decider.hpp"

namespace lagen {

namespace {

/// Functions of an arrow at (t + h, g^-1, -h), where xi becomes -xi.
std::vector<NodeId> reversed(Graph& graph, const System& system, const std::vector<NodeId>& functions)
{
    const Groupoid& groupoid = *system.groupoid;
    const NodeId step = system.discrete->step;
    Replacements back{{step, graph.negate(step)}, {system.time, graph.add(system.time, step)}};
    for (const NodeId xi : system.discrete->inner) back.emplace_back(xi, graph.negate(xi));
    return at(graph, groupoid, substitute(graph, functions, back), inverse(graph, groupoid, groupoid.arrow));
}

/// f along the fields that move the target and the source.
std::vector<NodeId> slopes(Graph& graph, const Groupoid& groupoid, NodeId f)
{
    const std::vector<NodeId> coordinates = groupoid.coordinates();
    std::vector<NodeId> out;
    for (const auto* fields : {&groupoid.left, &groupoid.right})
        for (const VectorField& field : *fields) {
            Replacements seeds;
            for (const ColumnEntry& entry : field) seeds.emplace_back(coordinates[entry.index], entry.value);
            out.push_back(directional(graph, std::vector<NodeId>{f}, seeds)[0]);
        }
    return out;
}

} // namespace

Decision decide_self_adjoint(Graph& graph, const System& system, const ProofBudget& budget)
{
    const DiscreteSystem& discrete = *system.discrete;
    const NodeId L = *discrete.lagrangian;
    const NodeId difference = graph.add(L, reversed(graph, system, {L})[0]);
    const auto decide = [&](NodeId residual) { return decide_on_arrows(graph, system, residual, budget); };
    const auto first_open = [&](const std::vector<NodeId>& residuals) {
        Decision decision;
        decision.status = ProofStatus::proved;
        for (std::size_t k = 0; k < residuals.size() && decision.status == ProofStatus::proved; ++k)
            if (!graph.is_zero(residuals[k])) decision = decide(residuals[k]);
        return decision;
    };
    Decision decision = first_open({difference});
    if (decision.status != ProofStatus::proved && !discrete.logarithm)
        decision = first_open(slopes(graph, *system.groupoid, difference));
    if (decision.status != ProofStatus::proved) return decision;
    std::vector<NodeId> residuals = reversed(graph, system, discrete.work.source);
    for (std::size_t a = 0; a < residuals.size(); ++a) residuals[a] = graph.add(residuals[a], discrete.work.target[a]);
    const std::vector<NodeId> inner = reversed(graph, system, discrete.work.inner);
    for (std::size_t k = 0; k < inner.size(); ++k)
        residuals.push_back(graph.subtract(inner[k], discrete.work.inner[k]));
    return first_open(residuals);
}

} // namespace lagen
