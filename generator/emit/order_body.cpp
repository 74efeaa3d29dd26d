// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/order_body.hpp"

#include "graph/core/operators.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

namespace lagen {

namespace {

/// So many values stay in the registers of a processor; below this the order of the outputs is left alone.
constexpr std::size_t enough_registers = 12;

bool is_number(const Graph& graph, NodeId id)
{
    return graph.op(id) == Op::constant || graph.op(id) == Op::pi;
}

/// Named nodes below `id` (itself where it has a name), each once, in order of appearance.
void add_reads(const Graph& graph, const BodyPlan& plan, NodeId id, std::vector<NodeId>& reads)
{
    std::vector<NodeId> stack = {id};
    while (!stack.empty()) {
        const NodeId node = stack.back();
        stack.pop_back();
        if (is_number(graph, node)) continue;
        if (plan.named[node] || graph.op(node) == Op::input || graph.op(node) == Op::component) {
            if (std::ranges::find(reads, node) == reads.end()) reads.push_back(node);
            continue;
        }
        const std::span<const NodeId> operands = graph.operands(node);
        stack.insert(stack.end(), operands.rbegin(), operands.rend());
    }
}

/// By node: how many registers its expression needs, where each operand is computed for itself (Sethi and Ullman 1970).
std::vector<std::uint32_t> registers_needed(const Graph& graph, const BodyPlan& plan)
{
    std::vector<std::uint32_t> needed(graph.size(), 1);
    std::vector<std::uint32_t> operands;
    for (NodeId id = 0; id < graph.size(); ++id) {
        if (!plan.used[id]) continue;
        operands.clear();
        for (const NodeId operand : graph.operands(id)) operands.push_back(needed[operand]);
        std::ranges::sort(operands, std::greater());
        for (std::size_t k = 0; k < operands.size(); ++k)
            needed[id] = std::max(needed[id], operands[k] + static_cast<std::uint32_t>(k));
    }
    return needed;
}

/// Post-order from each output in turn, without recursion.
class Walk {
  public:
    Walk(const Graph& graph, const BodyPlan& plan, const BodyRoots& roots, const std::vector<std::uint32_t>* registers)
        : graph_(graph), plan_(plan), registers_(registers), done_(graph.size(), false),
          placed_(plan.batches.size(), false)
    {
        for (std::size_t k = 0; k < roots.outputs.size(); ++k)
            if (!is_leaf(roots.outputs[k])) stores_[roots.outputs[k]].push_back(k);
        for (const NodeId id : roots.checked) checks_.push_back(id);
        std::ranges::sort(checks_);
    }

    /// Output number k: what is computed is stored at once, for whatever outputs it is; what is read, in its turn.
    void output(std::size_t k, NodeId root)
    {
        from(root);
        if (is_leaf(root)) place(BodyStep::Kind::store, root, k);
    }

    void from(NodeId root)
    {
        enter(root);
        while (!stack_.empty()) {
            Visit& visit = stack_.back();
            if (visit.next < visit.needed.size()) {
                enter(visit.needed[visit.next++]);
                continue;
            }
            const NodeId id = visit.node;
            stack_.pop_back();
            finish(id);
        }
    }

    std::vector<BodyStep> steps() { return std::move(steps_); }

  private:
    struct Visit {
        NodeId node;
        std::vector<NodeId> needed;
        std::size_t next = 0;
    };

    [[nodiscard]] bool is_leaf(NodeId id) const { return graph_.op(id) == Op::input || is_number(graph_, id); }
    void enter(NodeId id)
    {
        if (!done_[id]) stack_.push_back({id, needed_by(id)});
        done_[id] = true;
    }
    /// The operands, those that need most registers first if so wished; for a part of a batch all arguments of it.
    [[nodiscard]] std::vector<NodeId> needed_by(NodeId id) const
    {
        if (const auto batch = plan_.batch_of.find(id); batch != plan_.batch_of.end())
            return plan_.batches[batch->second].arguments;
        std::vector<NodeId> needed(graph_.operands(id).begin(), graph_.operands(id).end());
        if (registers_ != nullptr)
            std::ranges::stable_sort(needed, std::greater(), [&](NodeId node) { return (*registers_)[node]; });
        return needed;
    }
    void finish(NodeId id)
    {
        if (plan_.named[id] && !is_placed(id)) place(BodyStep::Kind::define, id);
        if (std::ranges::binary_search(checks_, id)) place(BodyStep::Kind::check, id);
        if (const auto stores = stores_.find(id); stores != stores_.end())
            for (const std::size_t k : stores->second) place(BodyStep::Kind::store, id, k);
    }
    void place(BodyStep::Kind kind, NodeId id, std::size_t index = 0)
    {
        steps_.push_back(make_step(graph_, plan_, kind, id, index));
    }
    /// By the statement of another node of its batch or family.
    bool is_placed(NodeId id)
    {
        if (graph_.op(id) == Op::stumpff) return !families_.insert(graph_.operands(id)[0]).second;
        const auto batch = plan_.batch_of.find(id);
        if (batch == plan_.batch_of.end()) return false;
        const bool placed = placed_[batch->second];
        placed_[batch->second] = true;
        return placed;
    }

    const Graph& graph_;
    const BodyPlan& plan_;
    const std::vector<std::uint32_t>* registers_;
    std::map<NodeId, std::vector<std::size_t>> stores_;
    std::vector<NodeId> checks_;
    std::vector<bool> done_;
    std::vector<bool> placed_;  ///< by batch
    std::set<NodeId> families_; ///< by their argument, that have been placed
    std::vector<Visit> stack_;
    std::vector<BodyStep> steps_;
};

} // namespace

BodyStep make_step(const Graph& graph, const BodyPlan& plan, BodyStep::Kind kind, NodeId id, std::size_t index)
{
    BodyStep step{kind, id, index};
    if (kind != BodyStep::Kind::define) {
        add_reads(graph, plan, id, step.needs);
        return step;
    }
    if (const auto found = plan.batch_of.find(id); found != plan.batch_of.end()) {
        const Batch& batch = plan.batches[found->second];
        for (const std::vector<NodeId>* side : {&batch.values, &batch.cosines})
            for (const NodeId value : *side)
                if (value != no_node) step.defines.push_back(value);
        for (const NodeId argument : batch.arguments) add_reads(graph, plan, argument, step.needs);
        return step;
    }
    step.defines.push_back(id);
    if (graph.op(id) == Op::stumpff) step.defines = plan.family_of(graph, id);
    if (graph.op(id) == Op::solve) {
        if (const auto components = plan.users.find(id); components != plan.users.end())
            step.defines.insert(step.defines.end(), components->second.begin(), components->second.end());
        // A closed form reads the entries of the matrix again.
        for (const NodeId entry : graph.operands(graph.operands(id)[0])) add_reads(graph, plan, entry, step.needs);
    }
    for (const NodeId operand : graph.operands(id)) add_reads(graph, plan, operand, step.needs);
    return step;
}

namespace {

/// How many values are alive: at most, and summed over the steps.
struct Pressure {
    std::size_t most = 0;
    std::size_t sum = 0;

    /// What fits into registers is best; of what does not, the order with fewer values to be put aside.
    [[nodiscard]] bool is_below(const Pressure& other) const
    {
        const bool spills = most > enough_registers;
        const bool other_spills = other.most > enough_registers;
        return spills != other_spills ? other_spills : sum < other.sum;
    }
};

Pressure pressure_of(const Graph& graph, const std::vector<BodyStep>& steps)
{
    std::vector<std::size_t> last(graph.size(), 0);
    for (std::size_t k = 0; k < steps.size(); ++k)
        for (const NodeId id : steps[k].needs) last[id] = k + 1;
    std::size_t live = 0;
    Pressure pressure;
    std::vector<bool> alive(graph.size(), false);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        for (const NodeId id : steps[k].defines)
            if (last[id] > k + 1 && !alive[id]) alive[id] = true, ++live;
        pressure.most = std::max(pressure.most, live);
        pressure.sum += live;
        for (const NodeId id : steps[k].needs)
            if (alive[id] && last[id] == k + 1) alive[id] = false, --live;
    }
    return pressure;
}

} // namespace

std::vector<BodyStep> order_body(const Graph& graph, const BodyPlan& plan, const BodyRoots& roots)
{
    const auto walked = [&](const std::vector<std::size_t>& order, const std::vector<std::uint32_t>* registers) {
        Walk walk(graph, plan, roots, registers);
        for (const std::size_t k : order) walk.output(k, roots.outputs[k]);
        for (const NodeId id : roots.checked) walk.from(id);
        for (const NodeId id : roots.kept) walk.from(id);
        return walk.steps();
    };
    std::vector<std::size_t> given(roots.outputs.size());
    std::iota(given.begin(), given.end(), std::size_t{0});
    std::vector<BodyStep> best = walked(given, nullptr);
    Pressure best_pressure = pressure_of(graph, best);
    if (best_pressure.most <= enough_registers) return best;
    const std::vector<std::uint32_t> registers = registers_needed(graph, plan);
    std::vector<std::vector<std::size_t>> orders = roots.arrangements;
    orders.insert(orders.begin(), given);
    const auto consider = [&](std::vector<BodyStep> steps) {
        const Pressure found = pressure_of(graph, steps);
        if (found.is_below(best_pressure)) best = std::move(steps), best_pressure = found;
    };
    for (const std::vector<std::size_t>& order : orders) {
        if (&order != &orders.front()) consider(walked(order, nullptr));
        consider(walked(order, &registers));
    }
    return best;
}

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
