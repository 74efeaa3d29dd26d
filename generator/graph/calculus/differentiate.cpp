// SPDX-License-Identifier: GPL-2.0-or-later
/// Forward and reverse sweeps by the rules of the operator table, and the rules of linear solves.
#include "graph/calculus/differentiate.hpp"

#include "graph/calculus/limits.hpp"
#include "graph/core/operators.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace lagen {
namespace {

/// A solve node taken apart: z = A^-1 b.
struct LinearSystem {
    std::vector<NodeId> matrix; ///< n x n by rows
    std::vector<NodeId> right;
    std::vector<NodeId> solution;
    MatrixStructure structure = MatrixStructure::general;

    [[nodiscard]] std::size_t order() const { return right.size(); }
    [[nodiscard]] std::vector<NodeId> transposed() const
    {
        std::vector<NodeId> result(matrix.size());
        for (std::size_t i = 0; i < order(); ++i)
            for (std::size_t j = 0; j < order(); ++j) result[j * order() + i] = matrix[i * order() + j];
        return result;
    }
};

LinearSystem system_of(Graph& graph, NodeId solve)
{
    LinearSystem system;
    const auto operands = graph.operands(solve);
    const auto entries = graph.operands(operands[0]);
    system.matrix.assign(entries.begin(), entries.end());
    system.right.assign(operands.begin() + 1, operands.end());
    system.structure = static_cast<MatrixStructure>(graph.payload(operands[0]));
    // The block is connected, so this finds the same nodes again.
    system.solution = graph.solve(system.matrix, system.right, system.structure);
    return system;
}

/// dz = A^-1 (db - dA z).
std::vector<NodeId> solve_tangent(Graph& graph, const LinearSystem& system, const std::vector<NodeId>& tangents)
{
    const std::size_t n = system.order();
    std::vector<NodeId> right;
    for (std::size_t i = 0; i < n; ++i) {
        NodeId sum = tangents[system.right[i]];
        for (std::size_t j = 0; j < n; ++j)
            sum = graph.subtract(sum, graph.multiply(tangents[system.matrix[i * n + j]], system.solution[j]));
        right.push_back(sum);
    }
    return graph.solve(system.matrix, right, system.structure);
}

/// The scalar rule: sum over the operands of (d node / d operand) * tangent.
NodeId node_tangent(Graph& graph, NodeId id, const std::vector<NodeId>& tangents, Limits* limits)
{
    const auto rule = operator_of(graph.op(id)).contribution;
    NodeId sum = graph.constant(0);
    for (std::size_t k = 0; k < graph.operands(id).size(); ++k) {
        const NodeId tangent = tangents[graph.operands(id)[k]];
        if (graph.is_zero(tangent)) continue;
        sum = graph.add(sum, limits != nullptr ? limits->contribution(id, k, tangent) : rule(graph, id, k, tangent));
    }
    return sum;
}

/// True for the nodes that depend on one of `inputs`; indexed by id.
std::vector<bool> dependent_nodes(const Graph& graph, const std::vector<NodeId>& nodes, std::span<const NodeId> inputs)
{
    std::vector<bool> active(nodes.empty() ? 0 : std::size_t{nodes.back()} + 1, false);
    for (const NodeId input : inputs)
        if (input < active.size()) active[input] = true;
    for (const NodeId id : nodes)
        for (const NodeId operand : graph.operands(id))
            if (active[operand]) active[id] = true;
    return active;
}

/// The reverse sweep: adjoints by id; those of a solve's components wait as a vector by solve node.
class ReverseSweep {
  public:
    ReverseSweep(Graph& graph, std::vector<bool> active)
        : graph_(graph), zero_(graph.constant(0)), active_(std::move(active)), adjoints_(active_.size(), zero_)
    {
    }

    void seed(NodeId output) { accumulate(output, graph_.constant(1)); }
    [[nodiscard]] NodeId adjoint(NodeId id) const { return id < adjoints_.size() ? adjoints_[id] : zero_; }

    void visit(NodeId id)
    {
        if (!active_[id]) return;
        if (graph_.op(id) == Op::solve) return visit_solve(id);
        const NodeId adjoint = adjoints_[id];
        if (graph_.is_zero(adjoint)) return;
        if (graph_.op(id) == Op::component) {
            auto& waiting = solve_adjoints_[graph_.operands(id)[0]];
            waiting.resize(graph_.operands(graph_.operands(id)[0]).size() - 1, zero_);
            waiting[graph_.payload(id)] = adjoint;
            return;
        }
        const auto rule = operator_of(graph_.op(id)).contribution;
        for (std::size_t k = 0; k < graph_.operands(id).size(); ++k) {
            const NodeId operand = graph_.operands(id)[k];
            if (active_[operand]) accumulate(operand, rule(graph_, id, k, adjoint));
        }
    }

  private:
    void accumulate(NodeId id, NodeId value) { adjoints_[id] = graph_.add(adjoints_[id], value); }

    /// lambda = A^-T zbar, bbar = lambda, Abar = -lambda z^T.
    void visit_solve(NodeId id)
    {
        const auto waiting = solve_adjoints_.find(id);
        if (waiting == solve_adjoints_.end()) return;
        const LinearSystem system = system_of(graph_, id);
        const std::size_t n = system.order();
        const bool general = system.structure == MatrixStructure::general;
        const auto lambda =
            graph_.solve(general ? system.transposed() : system.matrix, waiting->second, system.structure);
        for (std::size_t i = 0; i < n; ++i) {
            if (active_[system.right[i]]) accumulate(system.right[i], lambda[i]);
            for (std::size_t j = 0; j < n; ++j)
                if (const NodeId entry = system.matrix[i * n + j]; active_[entry])
                    accumulate(entry, graph_.negate(graph_.multiply(lambda[i], system.solution[j])));
        }
    }

    Graph& graph_;
    NodeId zero_;
    std::vector<bool> active_;
    std::vector<NodeId> adjoints_;
    std::map<NodeId, std::vector<NodeId>> solve_adjoints_;
};

/// With limits where `moving` is there: inputs that move, whether they have a seed or not.
using Moving = std::optional<std::span<const NodeId>>;

/// Forward sweeps over what the outputs need, each of which visits the nodes alone that its seeds move.
class ForwardSweep {
  public:
    ForwardSweep(Graph& graph, std::span<const NodeId> outputs, Moving moving)
        : graph_(graph), moving_(moving), zero_(graph.constant(0)), outputs_(outputs.begin(), outputs.end()),
          nodes_(reachable(graph, outputs))
    {
        const std::vector<NodeId>& nodes = nodes_;
        tangents_.assign(nodes.empty() ? 0 : std::size_t{nodes.back()} + 1, zero_);
        ends_.assign(tangents_.size() + 1, 0);
        for (const NodeId id : nodes)
            for (const NodeId operand : graph.operands(id)) ++ends_[operand + 1];
        std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
        users_.resize(ends_.back());
        std::vector<std::size_t> next = ends_;
        for (const NodeId id : nodes)
            for (const NodeId operand : graph.operands(id)) users_[next[operand]++] = id;
    }

    [[nodiscard]] std::vector<NodeId> along(std::span<const std::pair<NodeId, NodeId>> seeds)
    {
        std::vector<NodeId> inputs;
        for (const auto& [input, tangent] : seeds)
            if (input < tangents_.size()) inputs.push_back(input);
        const std::vector<NodeId> moved = moved_by(inputs);
        for (const auto& [input, tangent] : seeds)
            if (input < tangents_.size()) tangents_[input] = tangent;
        std::map<NodeId, std::vector<NodeId>> solutions;
        std::vector<bool> moves;
        std::optional<Limits> limits;
        if (moving_) {
            std::vector<NodeId> all(moving_->begin(), moving_->end());
            all.insert(all.end(), inputs.begin(), inputs.end());
            moves = dependent_nodes(graph_, nodes_, all);
            limits.emplace(graph_, outputs_, nodes_, moves);
        }
        for (const NodeId id : moved) {
            const Op op = graph_.op(id);
            if (op == Op::solve)
                solutions.emplace(id, solve_tangent(graph_, system_of(graph_, id), tangents_));
            else if (op == Op::component)
                tangents_[id] = solutions.at(graph_.operands(id)[0])[graph_.payload(id)];
            else if (op != Op::factor)
                tangents_[id] = node_tangent(graph_, id, tangents_, limits ? &*limits : nullptr);
        }
        std::vector<NodeId> result;
        for (const NodeId output : outputs_) result.push_back(tangents_[output]);
        for (const std::vector<NodeId>* touched : {&moved, &std::as_const(inputs)})
            for (const NodeId id : *touched) tangents_[id] = zero_;
        return result;
    }

  private:
    /// The nodes that depend on one of `inputs`, ascending, without these: one that is itself an inner node (a named
    /// quantity) keeps its tangent.
    [[nodiscard]] std::vector<NodeId> moved_by(const std::vector<NodeId>& inputs) const
    {
        std::vector<NodeId> open = inputs, moved;
        std::vector<bool> seen(tangents_.size(), false);
        for (const NodeId input : inputs) seen[input] = true;
        while (!open.empty()) {
            const NodeId id = open.back();
            open.pop_back();
            for (std::size_t k = ends_[id]; k < ends_[id + 1]; ++k) {
                if (seen[users_[k]]) continue;
                seen[users_[k]] = true;
                open.push_back(users_[k]);
                moved.push_back(users_[k]);
            }
        }
        std::ranges::sort(moved);
        return moved;
    }

    Graph& graph_;
    Moving moving_;
    NodeId zero_;
    std::vector<NodeId> outputs_, nodes_;
    std::vector<NodeId> users_; ///< of operand k: users_[ends_[k]], .., users_[ends_[k + 1] - 1]
    std::vector<std::size_t> ends_;
    std::vector<NodeId> tangents_; ///< zeros between two sweeps
};

std::vector<NodeId> directional(Graph& graph, std::span<const NodeId> outputs,
                                std::span<const std::pair<NodeId, NodeId>> seeds, Moving moving)
{
    return ForwardSweep(graph, outputs, moving).along(seeds);
}

} // namespace

std::vector<NodeId> directional(Graph& graph, std::span<const NodeId> outputs,
                                std::span<const std::pair<NodeId, NodeId>> seeds)
{
    return directional(graph, outputs, seeds, std::nullopt);
}

std::vector<NodeId> directional_with_limits(Graph& graph, std::span<const NodeId> outputs,
                                            std::span<const std::pair<NodeId, NodeId>> seeds,
                                            std::span<const NodeId> moving)
{
    return directional(graph, outputs, seeds, moving);
}

std::vector<NodeId> gradient(Graph& graph, NodeId output, std::span<const NodeId> inputs)
{
    const NodeId roots[] = {output};
    const auto nodes = reachable(graph, roots);
    // An input that is itself an inner node (a named quantity) keeps its adjoint and passes nothing on.
    std::vector<bool> kept(std::size_t{output} + 1, false);
    for (const NodeId input : inputs)
        if (input <= output) kept[input] = true;
    ReverseSweep sweep(graph, dependent_nodes(graph, nodes, inputs));
    sweep.seed(output);
    for (std::size_t k = nodes.size(); k-- > 0;)
        if (!kept[nodes[k]]) sweep.visit(nodes[k]);
    std::vector<NodeId> result;
    for (const NodeId input : inputs) result.push_back(sweep.adjoint(input));
    return result;
}

std::vector<NodeId> joined_rows(const std::vector<std::vector<NodeId>>& rows)
{
    std::vector<NodeId> entries;
    for (const std::vector<NodeId>& row : rows) entries.insert(entries.end(), row.begin(), row.end());
    return entries;
}

namespace {

std::vector<std::vector<NodeId>> jacobian(Graph& graph, std::span<const NodeId> outputs, std::span<const NodeId> inputs,
                                          Moving moving)
{
    std::vector<std::vector<NodeId>> result(outputs.size());
    const NodeId one = graph.constant(1);
    ForwardSweep sweep(graph, outputs, moving);
    for (const NodeId input : inputs) {
        const std::pair<NodeId, NodeId> seed[] = {{input, one}};
        const auto column = sweep.along(seed);
        for (std::size_t r = 0; r < outputs.size(); ++r) result[r].push_back(column[r]);
    }
    return result;
}

} // namespace

std::vector<std::vector<NodeId>> jacobian(Graph& graph, std::span<const NodeId> outputs, std::span<const NodeId> inputs)
{
    return jacobian(graph, outputs, inputs, std::nullopt);
}

std::vector<std::vector<NodeId>> jacobian_with_limits(Graph& graph, std::span<const NodeId> outputs,
                                                      std::span<const NodeId> inputs)
{
    return jacobian(graph, outputs, inputs, inputs);
}

} // namespace lagen
