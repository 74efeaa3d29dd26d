// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/simplify/probe_rounding.hpp"

#include "graph/core/rounded_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

/// Half a unit in the last of 24 places, a few times: below that, errors are luck.
constexpr double least_error = 8.0 / (1 << 24);
/// Nodes evaluated while states are sought; every form costs about as much again.
constexpr std::size_t largest_effort = 2'000'000;
constexpr std::size_t inputs_of_a_sum = 2;
constexpr int starts = 6;
/// Distances from the cancellation, relative: many of one size, so that the largest error of a group is no luck.
constexpr double distances[] = {-5 * 0x1p-12, -4 * 0x1p-12, -3 * 0x1p-12, 3 * 0x1p-12, 4 * 0x1p-12, 5 * 0x1p-12};

/// Positive values at the first half of the starts (roots and logarithms), values of both signs at the others.
std::vector<std::vector<double>> start_states(std::size_t inputs)
{
    std::uint64_t seed = 20260101;
    std::vector<std::vector<double>> states;
    for (int start = 0; start < starts; ++start) {
        std::vector<double> state;
        for (std::size_t k = 0; k < inputs; ++k) {
            seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
            const double part = static_cast<double>(seed >> 40U) / (1 << 24);
            const bool negative = start >= starts / 2 && ((seed >> 39U) & 1U) != 0;
            state.push_back(to_24_bits(negative ? -0.4 - part : 0.4 + part));
        }
        states.push_back(std::move(state));
    }
    return states;
}

/// Positions (in graph.inputs()) of the inputs of a sum that are moved: its own operands, then those declared last.
std::vector<std::size_t> inputs_to_move(const Graph& graph, NodeId sum)
{
    const NodeId roots[] = {sum};
    const auto below = reachable(graph, roots);
    const auto operands = graph.operands(sum);
    std::vector<std::size_t> own;
    std::vector<std::size_t> others;
    for (std::size_t k = graph.inputs().size(); k-- > 0;) {
        const NodeId input = graph.inputs()[k];
        if (!std::ranges::binary_search(below, input)) continue;
        (std::ranges::find(operands, input) != operands.end() ? own : others).push_back(k);
    }
    own.insert(own.end(), others.begin(), others.end());
    if (own.size() > inputs_of_a_sum) own.resize(inputs_of_a_sum);
    return own;
}

/// Moves input k until the sum vanishes but for 1e-7 of its operands (secants); false where it does not.
bool cancel(const Graph& graph, NodeId sum, const std::vector<NodeId>& nodes, std::vector<double>& state, std::size_t k)
{
    const auto value = [&](double x) {
        state[k] = x;
        const auto values = sweep(graph, nodes, state, false);
        const auto operands = graph.operands(sum);
        return values[sum] / (std::abs(values[operands[0]]) + std::abs(values[operands[1]]));
    };
    double x0 = state[k];
    double x1 = x0 * 1.0625;
    double f0 = value(x0);
    for (int trial = 0; trial < 12; ++trial) {
        const double f1 = value(x1);
        if (std::abs(f1) < 1e-7) return x1 != 0;
        const double next = x1 - f1 * (x1 - x0) / (f1 - f0);
        x0 = x1;
        f0 = f1;
        x1 = next;
        if (!(std::abs(x1) < 1e3)) return false;
    }
    return false;
}

} // namespace

RoundingProbe::RoundingProbe(const Graph& graph, std::span<const NodeId> outputs)
    : graph_(graph), outputs_(outputs.begin(), outputs.end()), nodes_(reachable(graph, outputs))
{
    choose_groups(nodes_);
}

void RoundingProbe::choose_groups(const std::vector<NodeId>& nodes)
{
    const auto bases = start_states(graph_.inputs().size());
    add_group(bases);
    std::size_t effort = 0;
    for (const NodeId sum : nodes) {
        if (graph_.op(sum) != Op::add && graph_.op(sum) != Op::subtract) continue;
        const NodeId roots[] = {sum};
        const auto below = reachable(graph_, roots);
        for (const std::size_t k : inputs_to_move(graph_, sum)) {
            effort += starts * (6 * below.size() + std::size(distances) * nodes.size());
            if (effort > largest_effort) return;
            std::vector<State> states;
            for (State state : bases) {
                if (!cancel(graph_, sum, below, state, k)) continue;
                const double zero = state[k];
                for (const double distance : distances) {
                    state[k] = to_24_bits(zero * (1 + distance));
                    states.push_back(state);
                }
            }
            if (!states.empty()) add_group(std::move(states));
        }
    }
}

void RoundingProbe::add_group(std::vector<State> states)
{
    Group group{std::move(states), {}, {}};
    for (const State& state : group.states) {
        const auto values = sweep(graph_, nodes_, state, false);
        std::vector<double> exact;
        for (const NodeId output : outputs_) exact.push_back(values[output]);
        group.exact.push_back(std::move(exact));
    }
    group.worst = worst_errors(group, outputs_, nodes_);
    groups_.push_back(std::move(group));
}

std::vector<double> RoundingProbe::worst_errors(const Group& group, std::span<const NodeId> form,
                                                const std::vector<NodeId>& nodes) const
{
    std::vector<double> worst(form.size(), 0);
    for (std::size_t s = 0; s < group.states.size(); ++s) {
        const auto values = sweep(graph_, nodes, group.states[s], true);
        for (std::size_t k = 0; k < form.size(); ++k) {
            const double exact = group.exact[s][k];
            if (!std::isfinite(exact) || exact == 0) continue; // outside the domain, or no relative error
            const double error = std::abs(values[form[k]] - exact) / std::abs(exact);
            worst[k] = error <= worst[k] ? worst[k] : error; // NaN counts
        }
    }
    return worst;
}

std::vector<bool> RoundingProbe::keeps_digits(std::span<const NodeId> form) const
{
    const auto nodes = reachable(graph_, form);
    std::vector<bool> keeps(form.size(), true);
    for (const Group& group : groups_) {
        const auto worst = worst_errors(group, form, nodes);
        for (std::size_t k = 0; k < form.size(); ++k)
            if (!(worst[k] <= allowed_loss * std::max(group.worst[k], least_error)) && std::isfinite(group.worst[k]))
                keeps[k] = false;
    }
    return keeps;
}

} // namespace lagen
