// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/overlap_steps.hpp"

#include "graph/core/operators.hpp"

#include <algorithm>
#include <tuple>

namespace lagen {

namespace {

/// Additions and multiplications, with the moves between them, that begin in a cycle.
constexpr double width = 1.5;

/// The same where nothing waits: what comes next is chosen for this, so that no latency is left bare.
constexpr double best_width = 2;

/// Operations that a processor looks ahead: 320 to 512 instructions, moves among them.
constexpr double window = 80;

/// A body of fewer operations is overseen nearly whole, whatever its order.
constexpr double smallest_body = 4 * window;

/// Bodies of more steps are cut into parts, or take no notable time.
constexpr std::size_t largest_body = 2'500;

/// Another order is worth the registers that it may take where it saves this part of the time.
constexpr double least_gain = 0.05;

/// What a step takes and what it waits for.
struct Timing {
    struct Wait {
        std::size_t step = 0; ///< that computes what is read
        double latency = 0;   ///< from there to the result of this one
    };
    double operations = 0;
    double latency = 0; ///< of what waits for inputs alone
    std::vector<Wait> waits;
};

/// Linear algebra takes as long as it computes.
double latency_of(const Graph& graph, NodeId id)
{
    const bool block = graph.op(id) == Op::factor || graph.op(id) == Op::solve;
    return block ? operation_weight(graph, id) / width : operation_latency(graph, id);
}

/// The timings of all steps.
class Clock {
  public:
    Clock(const Graph& graph, const BodyPlan& plan, const std::vector<BodyStep>& steps)
        : graph_(graph), plan_(plan), born_(graph.size(), no_step)
    {
        for (std::size_t k = 0; k < steps.size(); ++k)
            for (const NodeId id : steps[k].defines) born_[id] = k;
        for (const BodyStep& step : steps) timings_.push_back(timing_of(step));
    }

    [[nodiscard]] std::vector<Timing> timings() { return std::move(timings_); }

  private:
    static constexpr std::size_t no_step = SIZE_MAX;

    Timing timing_of(const BodyStep& step)
    {
        Timing timing;
        if (step.kind == BodyStep::Kind::check) timing.operations = 1;
        const bool computes = step.kind == BodyStep::Kind::define || !plan_.named[step.node];
        if (step.kind != BodyStep::Kind::check && computes) add_own(step.node, timing);
        if (timing.waits.empty())
            for (const NodeId id : step.needs) wait(id, timing.latency, timing);
        return timing;
    }

    /// Batches and linear algebra as a whole, else the expression.
    void add_own(NodeId id, Timing& timing)
    {
        if (const auto found = plan_.batch_of.find(id); found != plan_.batch_of.end()) {
            const Batch& batch = plan_.batches[found->second];
            for (const std::vector<NodeId>* side : {&batch.values, &batch.cosines})
                for (const NodeId value : *side)
                    if (value != no_node) timing.operations += batch.kind == Batch::Kind::terms ? width / 4 : width;
            timing.latency = latency_of(graph_, id);
        } else if (graph_.op(id) == Op::factor || graph_.op(id) == Op::solve || graph_.op(id) == Op::stumpff) {
            timing.operations = operation_weight(graph_, id);
            timing.latency = latency_of(graph_, id);
        } else {
            add_expression(id, timing);
        }
    }

    /// Walks the unnamed nodes below `root`, with the latency from each to the root. One product of a sum is computed
    /// with it.
    void add_expression(NodeId root, Timing& timing)
    {
        struct Visit {
            NodeId node;
            double after; ///< from the result of `node` on
            bool fused;
        };
        std::vector<Visit> stack{{root, 0, false}};
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            if (visit.node != root && has_name(visit.node)) {
                wait(visit.node, visit.after, timing);
                continue;
            }
            const double own = visit.fused ? 0 : latency_of(graph_, visit.node);
            if (own > 0)
                timing.operations += graph_.op(visit.node) == Op::divide ? width : own / operator_of(Op::add).latency;
            timing.latency = std::max(timing.latency, visit.after + own);
            const Op op = graph_.op(visit.node);
            bool free = op == Op::add || op == Op::subtract;
            for (const NodeId operand : graph_.operands(visit.node)) {
                const bool fused = free && !has_name(operand) && graph_.op(operand) == Op::multiply;
                stack.push_back({operand, visit.after + own, fused});
                if (fused) free = false;
            }
        }
    }

    [[nodiscard]] bool has_name(NodeId id) const { return plan_.named[id] || graph_.op(id) == Op::component; }

    void wait(NodeId id, double latency, Timing& timing) const
    {
        if (born_[id] != no_step) timing.waits.push_back({born_[id], latency});
    }

    const Graph& graph_;
    const BodyPlan& plan_;
    std::vector<std::size_t> born_; ///< by node: the step that computes it
    std::vector<Timing> timings_;
};

/// Cycles that a processor takes for the steps in the order `order`: `width` operations begin in a cycle, in order,
/// none before all those are done that lie more than a window back.
double time_of(const std::vector<Timing>& timings, const std::vector<std::size_t>& order)
{
    std::vector<double> ready(timings.size(), 0);
    std::vector<std::pair<double, double>> retired; // operations up to a step, when it and all before it are done
    std::size_t behind = 0;
    double begun = 0;
    double operations = 0;
    double done = 0;
    for (const std::size_t k : order) {
        const Timing& timing = timings[k];
        for (; behind < retired.size() && retired[behind].first < operations - window; ++behind)
            begun = std::max(begun, retired[behind].second);
        ready[k] = begun + timing.latency;
        for (const Timing::Wait& wait : timing.waits) ready[k] = std::max(ready[k], ready[wait.step] + wait.latency);
        begun += timing.operations / width;
        operations += timing.operations;
        done = std::max(done, ready[k]);
        retired.emplace_back(operations, done);
    }
    return done;
}

/// From the last step to the first: of the steps whose users are placed, and whose result these do not need earlier,
/// the one that the inputs are farthest from. So each stands as late as it may, next to its first use but for its
/// latency.
std::vector<std::size_t> latest_order(const std::vector<Timing>& timings)
{
    const std::size_t count = timings.size();
    std::vector<std::size_t> users(count, 0);
    std::vector<double> depth(count, 0); // from the inputs to the result
    for (std::size_t k = 0; k < count; ++k) {
        depth[k] = timings[k].latency;
        for (const Timing::Wait& wait : timings[k].waits) {
            depth[k] = std::max(depth[k], depth[wait.step] + wait.latency);
            ++users[wait.step];
        }
    }
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < count; ++k)
        if (users[k] == 0) open.push_back(k);
    std::vector<double> due(count, 0); // cycles before the end, at least
    std::vector<std::size_t> order;
    double now = 0;
    while (!open.empty()) {
        const auto soonest = std::ranges::min_element(open, {}, [&](std::size_t k) { return due[k]; });
        now = std::max(now, due[*soonest]);
        const auto rank = [&](std::size_t k) { return std::tuple(due[k] <= now, depth[k], k); };
        const auto best = std::ranges::max_element(open, {}, rank);
        const std::size_t chosen = *best;
        open.erase(best);
        order.push_back(chosen);
        now += timings[chosen].operations / best_width;
        for (const Timing::Wait& wait : timings[chosen].waits) {
            due[wait.step] = std::max(due[wait.step], now + wait.latency);
            if (--users[wait.step] == 0) open.push_back(wait.step);
        }
    }
    std::ranges::reverse(order);
    return order;
}

} // namespace

std::vector<BodyStep> overlap_steps(const Graph& graph, const BodyPlan& plan, std::vector<BodyStep> steps)
{
    if (steps.size() > largest_body) return steps;
    const std::vector<Timing> timings = Clock(graph, plan, steps).timings();
    double operations = 0;
    for (const Timing& timing : timings) operations += timing.operations;
    if (operations < smallest_body) return steps;
    std::vector<std::size_t> order(steps.size());
    for (std::size_t k = 0; k < steps.size(); ++k) order[k] = k;
    const double before = time_of(timings, order);
    order = latest_order(timings);
    const double after = time_of(timings, order);
    if (after > (1 - least_gain) * before) return steps;
    std::vector<BodyStep> result;
    for (const std::size_t k : order) result.push_back(std::move(steps[k]));
    return result;
}

} // namespace lagen
