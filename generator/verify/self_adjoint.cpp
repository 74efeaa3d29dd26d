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

/// What vanishes where the work of forces is undone. With a logarithm the part of it along xi goes by D^-T to the
/// momenta at both ends, so that it is its sum with f^+- that has to vanish, multiplied by D(-xi)^T here; with a
/// connection, which takes it to the base as well, each part is asked to vanish by itself.
std::vector<NodeId> work_defects(Graph& graph, const System& system)
{
    const DiscreteSystem& discrete = *system.discrete;
    std::vector<NodeId> defects = reversed(graph, system, discrete.work.source);
    for (std::size_t a = 0; a < defects.size(); ++a) defects[a] = graph.add(defects[a], discrete.work.target[a]);
    std::vector<NodeId> along = reversed(graph, system, discrete.work.inner);
    for (std::size_t k = 0; k < along.size(); ++k) along[k] = graph.subtract(discrete.work.inner[k], along[k]);
    if (defects.empty() || !discrete.logarithm || !system.groupoid->connection.empty()) {
        defects.insert(defects.end(), along.begin(), along.end());
        return defects;
    }
    const std::size_t horizontal = system.groupoid->horizontal(), m = along.size();
    const std::vector<NodeId> D = reversed(graph, system, discrete.logarithm->differential); // over xi alone
    for (std::size_t k = 0; k < m; ++k)
        for (std::size_t c = 0; c < m; ++c)
            along[k] = graph.add(along[k], graph.multiply(D[c * m + k], defects[horizontal + c]));
    defects.resize(horizontal);
    defects.insert(defects.end(), along.begin(), along.end());
    return defects;
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
    return first_open(work_defects(graph, system));
}

} // namespace lagen
