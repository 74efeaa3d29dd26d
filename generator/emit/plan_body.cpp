// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/plan_body.hpp"

#include "graph/core/operators.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <tuple>

namespace lagen {

namespace {

/// Operations inside one printed expression; longer ones are cut by a named term.
constexpr std::size_t largest_expression = 16;

bool is_leaf(Op op)
{
    return kind_of(op) == OpKind::leaf;
}

/// Never named on their own: leaves and entries of a solution.
bool has_name_already(Op op)
{
    return is_leaf(op) || op == Op::component;
}

bool is_linear_algebra(Op op)
{
    return op == Op::factor || op == Op::solve;
}

std::vector<std::size_t> count_uses(const Graph& graph, const std::vector<NodeId>& nodes,
                                    std::span<const NodeId> outputs)
{
    std::vector<std::size_t> uses(graph.size(), 0);
    for (const NodeId id : nodes)
        for (const NodeId operand : graph.operands(id)) ++uses[operand];
    for (const NodeId id : outputs) ++uses[id];
    return uses;
}

/// Operands that the spelling of `id` repeats, so that they must have a name.
bool repeats_operands(const Graph& graph, NodeId id)
{
    const Op op = graph.op(id);
    return is_linear_algebra(op) || op == Op::power || op == Op::minimum || op == Op::maximum || op == Op::sign;
}

/// What a node is to a batch: its kind and its argument.
std::optional<std::pair<Batch::Kind, NodeId>> batched_operation(const Graph& graph, NodeId id)
{
    const std::span<const NodeId> operands = graph.operands(id);
    const Op op = graph.op(id);
    if (op == Op::sin || op == Op::cos) return std::pair{Batch::Kind::angles, operands[0]};
    if (op == Op::sqrt) return std::pair{Batch::Kind::roots, operands[0]};
    if (op == Op::divide && graph.is_one(operands[0])) return std::pair{Batch::Kind::reciprocals, operands[1]};
    return std::nullopt;
}

/// One angle is worth a call where both its values are used, several where they have three; with fewer than four square
/// roots or reciprocals the processor is not busy long enough.
bool is_worth_a_call(const Batch& batch)
{
    if (batch.kind != Batch::Kind::angles) return batch.arguments.size() >= 4;
    const auto used = [](NodeId id) { return id != no_node; };
    const auto values = std::ranges::count_if(batch.values, used) + std::ranges::count_if(batch.cosines, used);
    return values >= 3 || (values == 2 && batch.arguments.size() == 1);
}

void add_batch(Batch batch, BodyPlan& plan)
{
    if (!is_worth_a_call(batch)) return;
    for (const std::vector<NodeId>* side : {&batch.values, &batch.cosines})
        for (const NodeId id : *side)
            if (id != no_node) plan.batch_of[id] = plan.batches.size();
    plan.batches.push_back(std::move(batch));
}

/// Of every kind a batch for all arguments that depend on no result of a batch, one for those that depend on these, ...
void find_batches(const Graph& graph, const std::vector<NodeId>& nodes, const AlikeGroups& terms, BodyPlan& plan)
{
    std::vector<std::size_t> level(graph.size(), 0);
    std::map<std::tuple<std::size_t, Batch::Kind, NodeId>, std::pair<NodeId, NodeId>> found; // by level, argument
    for (const NodeId id : nodes) {
        for (const NodeId operand : graph.operands(id)) level[id] = std::max(level[id], level[operand]);
        const auto operation = batched_operation(graph, id);
        if (!operation || terms.contains(id)) continue;
        const auto [kind, argument] = *operation;
        const std::tuple key{level[argument], kind, argument};
        auto& [value, cosine] = found.try_emplace(key, no_node, no_node).first->second;
        (graph.op(id) == Op::cos ? cosine : value) = id;
        level[id] = level[argument] + 1;
    }
    for (auto entry = found.begin(); entry != found.end();) {
        const auto [first_level, kind, first] = entry->first;
        Batch batch{kind, {}, {}, {}};
        for (; entry != found.end(); ++entry) {
            const auto& [entry_level, entry_kind, argument] = entry->first;
            if (entry_level != first_level || entry_kind != kind) break;
            batch.arguments.push_back(argument);
            batch.values.push_back(entry->second.first);
            if (kind == Batch::Kind::angles) batch.cosines.push_back(entry->second.second);
        }
        add_batch(std::move(batch), plan);
    }
}

/// Groups of terms that are computed, not given.
void add_terms(const Graph& graph, const AlikeGroups& terms, BodyPlan& plan)
{
    for (std::size_t k = 0; k < terms.groups.size(); ++k) {
        const AlikeTerms& group = terms.groups[k];
        if (graph.op(group.lanes[0]) == Op::input || group.is_included) continue;
        Batch batch{Batch::Kind::terms, {}, group.lanes, {}, k};
        for (const TermOperand& operand : group.operands) {
            const std::vector<NodeId>& nodes = operand.group ? terms.groups[*operand.group].lanes : operand.nodes;
            batch.arguments.insert(batch.arguments.end(), nodes.begin(), nodes.end());
        }
        for (const NodeId id : group.lanes) plan.batch_of[id] = plan.batches.size();
        plan.batches.push_back(std::move(batch));
    }
}

/// Marks the groups of which a single lane is read: by an output, by a node in no group, or by a group otherwise than
/// lane by lane.
void find_taken_apart(const Graph& graph, const std::vector<NodeId>& nodes, std::span<const NodeId> outputs,
                      const AlikeGroups& terms, BodyPlan& plan)
{
    const auto read = [&](std::span<const NodeId> ids) {
        for (const NodeId id : ids)
            if (const auto found = plan.batch_of.find(id); found != plan.batch_of.end())
                plan.batches[found->second].taken_apart = true;
    };
    read(outputs);
    for (const NodeId id : nodes)
        if (!terms.contains(id)) read(graph.operands(id));
    for (const AlikeTerms& group : terms.groups)
        for (const TermOperand& operand : group.operands) read(operand.nodes);
}

/// By node: a Stumpff function of which another order, of the same argument, is used too.
std::vector<bool> find_families(const Graph& graph, const std::vector<NodeId>& nodes)
{
    std::vector<std::size_t> orders(graph.size(), 0);
    for (const NodeId id : nodes)
        if (graph.op(id) == Op::stumpff) ++orders[graph.operands(id)[0]];
    std::vector<bool> family(graph.size(), false);
    for (const NodeId id : nodes)
        if (graph.op(id) == Op::stumpff) family[id] = orders[graph.operands(id)[0]] > 1;
    return family;
}

/// Ascending walk: a node is named where it is used twice, repeated by its user, part of a batch, or where
/// the expression would grow too long.
std::vector<bool> choose_named(const Graph& graph, const std::vector<NodeId>& nodes, std::span<const NodeId> outputs,
                               const BodyPlan& plan)
{
    const std::vector<std::size_t> uses = count_uses(graph, nodes, outputs);
    const std::vector<bool> family = find_families(graph, nodes);
    std::vector<bool> named(graph.size(), false);
    for (const NodeId id : nodes) {
        if (is_linear_algebra(graph.op(id)) || (uses[id] > 1 && !has_name_already(graph.op(id)))) named[id] = true;
        if (plan.batch_of.contains(id) || family[id] || needs_chain(graph, id)) named[id] = true;
        if (repeats_operands(graph, id))
            for (const NodeId operand : graph.operands(id))
                if (!has_name_already(graph.op(operand))) named[operand] = true;
    }
    std::vector<std::size_t> size(graph.size(), 0);
    for (const NodeId id : nodes) {
        std::size_t total = 1;
        for (const NodeId operand : graph.operands(id))
            total += named[operand] || has_name_already(graph.op(operand)) ? 0 : size[operand];
        size[id] = total;
        if (total >= largest_expression) named[id] = true;
    }
    for (const NodeId id : outputs) // an output that nothing else uses is printed where it is stored
        if (uses[id] == 1 && !is_linear_algebra(graph.op(id)) && !plan.batch_of.contains(id) && !family[id] &&
            !needs_chain(graph, id))
            named[id] = false;
    return named;
}

} // namespace

bool needs_chain(const Graph& graph, NodeId id)
{
    return graph.op(id) == Op::power && std::abs(static_cast<std::int32_t>(graph.payload(id))) > 4;
}

std::vector<NodeId> BodyPlan::family_of(const Graph& graph, NodeId id) const
{
    std::vector<NodeId> family;
    const NodeId argument = graph.operands(id)[0];
    for (const NodeId node : users.at(argument))
        if (graph.op(node) == Op::stumpff) family.push_back(node);
    return family;
}

BodyPlan plan_body(const Graph& graph, std::span<const NodeId> outputs, const AlikeGroups& terms,
                   std::span<const NodeId> kept)
{
    std::vector<NodeId> roots(outputs.begin(), outputs.end());
    roots.insert(roots.end(), kept.begin(), kept.end());
    const std::vector<NodeId> nodes = reachable(graph, roots);
    BodyPlan plan;
    add_terms(graph, terms, plan);
    find_taken_apart(graph, nodes, outputs, terms, plan);
    find_batches(graph, nodes, terms, plan);
    plan.used.assign(graph.size(), false);
    for (const NodeId id : nodes) plan.used[id] = true;
    plan.named = choose_named(graph, nodes, outputs, plan);
    for (const NodeId id : nodes)
        if (const Op op = graph.op(id); op == Op::stumpff || op == Op::component || op == Op::solve)
            plan.users[graph.operands(id)[0]].push_back(id);
    return plan;
}

} // namespace lagen
