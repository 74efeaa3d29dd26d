// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/plan_body.hpp"

#include <cstdlib>

namespace lagen {

namespace {

/// Operations inside one printed expression; longer ones are cut by a named term.
constexpr std::size_t largest_expression = 16;

bool is_leaf(Op op)
{
    return op == Op::constant || op == Op::pi || op == Op::input;
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

/// For every angle the node of its sine and of its cosine, where both are used.
std::vector<NodeId> find_partners(const Graph& graph, const std::vector<NodeId>& nodes)
{
    constexpr NodeId none = static_cast<NodeId>(-1);
    std::vector<NodeId> sine(graph.size(), none);
    std::vector<NodeId> cosine(graph.size(), none);
    std::vector<NodeId> partner(graph.size(), none);
    for (const NodeId id : nodes) {
        if (graph.op(id) == Op::sin) sine[graph.operands(id)[0]] = id;
        if (graph.op(id) == Op::cos) cosine[graph.operands(id)[0]] = id;
    }
    for (const NodeId id : nodes) {
        if (sine[id] == none || cosine[id] == none) continue;
        partner[sine[id]] = cosine[id];
        partner[cosine[id]] = sine[id];
    }
    return partner;
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

/// Ascending walk: a node is named where it is used twice, repeated by its user, a pair of sine and cosine, or where
/// the expression would grow too long.
std::vector<bool> choose_named(const Graph& graph, const std::vector<NodeId>& nodes, std::span<const NodeId> outputs,
                               const std::vector<NodeId>& partner)
{
    const std::vector<std::size_t> uses = count_uses(graph, nodes, outputs);
    const std::vector<bool> family = find_families(graph, nodes);
    std::vector<bool> named(graph.size(), false);
    for (const NodeId id : nodes) {
        if (is_linear_algebra(graph.op(id)) || (uses[id] > 1 && !has_name_already(graph.op(id)))) named[id] = true;
        if (partner[id] != static_cast<NodeId>(-1) || family[id] || needs_chain(graph, id)) named[id] = true;
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
        if (uses[id] == 1 && !is_linear_algebra(graph.op(id)) && partner[id] == static_cast<NodeId>(-1) &&
            !family[id] && !needs_chain(graph, id))
            named[id] = false;
    return named;
}

/// Post-order from each output in turn, without recursion.
class Walk {
  public:
    Walk(const Graph& graph, const std::vector<NodeId>& partner, BodyPlan& plan)
        : graph_(graph), partner_(partner), plan_(plan), done_(graph.size(), false)
    {
    }
    void from(NodeId root)
    {
        enter(root);
        while (!stack_.empty()) {
            auto& [id, next] = stack_.back();
            const std::span<const NodeId> operands = graph_.operands(id);
            if (next < operands.size()) {
                enter(operands[next++]);
                continue;
            }
            finish(id);
            stack_.pop_back();
        }
    }

  private:
    void enter(NodeId id)
    {
        if (!done_[id]) stack_.emplace_back(id, 0);
        done_[id] = true;
    }
    void finish(NodeId id)
    {
        if (!plan_.named[id]) return;
        const NodeId other = partner_[id];
        if (other == static_cast<NodeId>(-1)) {
            plan_.order.push_back(id);
            return;
        }
        done_[other] = true; // its operand is this node's, which is done
        plan_.order.push_back(graph_.op(id) == Op::sin ? id : other);
        plan_.order.push_back(graph_.op(id) == Op::sin ? other : id);
    }

    const Graph& graph_;
    const std::vector<NodeId>& partner_;
    BodyPlan& plan_;
    std::vector<bool> done_;
    std::vector<std::pair<NodeId, std::size_t>> stack_;
};

} // namespace

bool needs_chain(const Graph& graph, NodeId id)
{
    return graph.op(id) == Op::power && std::abs(static_cast<std::int32_t>(graph.payload(id))) > 4;
}

BodyPlan plan_body(const Graph& graph, std::span<const NodeId> outputs)
{
    const std::vector<NodeId> nodes = reachable(graph, outputs);
    const std::vector<NodeId> partner = find_partners(graph, nodes);
    BodyPlan plan;
    plan.used.assign(graph.size(), false);
    for (const NodeId id : nodes) plan.used[id] = true;
    plan.named = choose_named(graph, nodes, outputs, partner);
    Walk walk(graph, partner, plan);
    for (const NodeId id : outputs) walk.from(id);
    return plan;
}

} // namespace lagen
