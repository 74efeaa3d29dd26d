// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/elimination/cut_solves.hpp"

#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// Nodes that all solutions together may make.
constexpr std::size_t largest_solution = 3'000'000;

} // namespace

CutSolves::CutSolves(Graph& graph, std::span<const NodeId> outputs) : graph_(graph), outputs_(outputs.size())
{
    const std::vector<NodeId> nodes = reachable(graph, outputs);
    read_systems(nodes);
    if (!systems_.empty()) cut(nodes, outputs);
}

void CutSolves::read_systems(const std::vector<NodeId>& nodes)
{
    for (const NodeId id : nodes) {
        if (graph_.op(id) != Op::factor) continue;
        const HessianOrigin* origin = graph_.hessian_origin(id);
        if (origin == nullptr) continue;
        auto hessian = read_hessian(graph_, origin->value, origin->variables);
        if (!hessian || hessian->definitions.size() == hessian->order) continue; // no terms: W itself
        system_of_[id] = systems_.size();
        systems_.push_back({id, std::move(*hessian), 0});
    }
}

void CutSolves::cut(const std::vector<NodeId>& nodes, std::span<const NodeId> outputs)
{
    std::map<NodeId, std::size_t> solve_of;
    std::vector<std::pair<NodeId, NodeId>> stand_ins;
    std::vector<NodeId> roots(outputs.begin(), outputs.end());
    for (const NodeId id : nodes) {
        if (graph_.op(id) == Op::solve) {
            const auto system = system_of_.find(graph_.operands(id)[0]);
            if (system == system_of_.end()) continue;
            solve_of[id] = solves_.size();
            const auto right = graph_.operands(id).subspan(1);
            solves_.push_back({system->second, {}, roots.size(), right.size()});
            roots.insert(roots.end(), right.begin(), right.end());
        } else if (graph_.op(id) == Op::component) {
            const auto solve = solve_of.find(graph_.operands(id)[0]);
            if (solve == solve_of.end()) continue;
            // The name has spaces: no model can have it.
            const NodeId input = graph_.input("the value of node " + std::to_string(id));
            solves_[solve->second].unknowns.emplace_back(graph_.payload(id), input);
            stand_ins.emplace_back(id, input);
        }
    }
    for (System& system : systems_) {
        system.first_piece = roots.size();
        for (const SparseHessian::Terms& terms : system.hessian.definitions)
            for (const auto& [variable, coefficient] : terms) roots.push_back(coefficient);
        for (const SparseHessian::Entry& entry : system.hessian.entries) roots.push_back(entry.value);
    }
    pieces_ = substitute(graph_, roots, stand_ins);
}

SparseHessian CutSolves::hessian_of(const System& system, std::span<const NodeId> pieces) const
{
    SparseHessian hessian = system.hessian;
    std::size_t next = system.first_piece;
    for (SparseHessian::Terms& terms : hessian.definitions)
        for (auto& [variable, coefficient] : terms) coefficient = pieces[next++];
    for (SparseHessian::Entry& entry : hessian.entries) entry.value = pieces[next++];
    return hessian;
}

std::vector<NodeId> CutSolves::join(std::span<const NodeId> pieces, std::vector<NodeId>& pivots) const
{
    std::vector<Elimination> eliminations;
    for (const System& system : systems_) {
        auto elimination = eliminate(graph_, hessian_of(system, pieces));
        if (!elimination) return {};
        for (const Elimination::Step& step : elimination->steps)
            if (!elimination->is_term[step.variable] && !graph_.is_constant(step.pivot)) pivots.push_back(step.pivot);
        eliminations.push_back(std::move(*elimination));
    }
    const std::size_t limit = graph_.size() + largest_solution;
    std::vector<std::pair<NodeId, NodeId>> solutions;
    for (const Solve& solve : solves_) {
        if (graph_.size() > limit) return {};
        const auto right = substitute(graph_, pieces.subspan(solve.first_piece, solve.order), solutions);
        const std::vector<NodeId> z = solve_by(graph_, eliminations[solve.system], right);
        for (const auto& [index, input] : solve.unknowns) solutions.emplace_back(input, z[index]);
    }
    return substitute(graph_, pieces.first(outputs_), solutions);
}

} // namespace lagen
