// SPDX-License-Identifier: GPL-2.0-or-later
#include "least/prover.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "graph/core/operators.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

/// One budget for all proofs about a scene: what is not proved within it is not done.
ProofBudget budget_of_a_rule()
{
    ProofBudget budget;
    budget.terms = 4000;
    budget.products = 1'000'000;
    budget.points = 2;
    budget.tries = 60;
    budget.searches = 2;
    return budget;
}

/// Operations that are not the same analytic function on both sides of every point: derivatives do not tell all of
/// them.
bool has_branches(Op op)
{
    return !is_meromorphic(op) && operator_of(op).smoothness != Smoothness::system;
}

} // namespace

bool may_jump(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<NodeId>& lanes)
{
    const std::vector<bool> moves = depends_on(graph, lanes);
    bool has_kinks = false, divides = false;
    for (const NodeId node : reachable(graph, nodes)) {
        if (!moves[node]) continue;
        const Op op = graph.op(node);
        const bool is_inverse = op == Op::power && static_cast<std::int32_t>(graph.payload(node)) < 0;
        if (is_inverse || (op == Op::divide && moves[graph.operands(node)[1]])) divides = true;
        if (!has_branches(op)) continue;
        if (operator_of(op).smoothness != Smoothness::kinked && op != Op::sqrt) return true;
        has_kinks = true;
    }
    return has_kinks && divides;
}

bool has_branch(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<NodeId>& lanes)
{
    const std::vector<bool> moves = depends_on(graph, lanes);
    return std::ranges::any_of(reachable(graph, nodes),
                               [&](NodeId node) { return moves[node] && has_branches(graph.op(node)); });
}

Prover::Prover(Graph& graph, ProofSetting setting, Replacements values)
    : graph_(&graph), setting_(std::move(setting)), values_(std::move(values))
{
}

Replacements Prover::values_of(const std::vector<NodeId>& parameters) const
{
    Replacements values;
    for (const auto& each : values_)
        if (std::ranges::find(parameters, each.first) != parameters.end()) values.push_back(each);
    return values;
}

Prover::There& Prover::where(std::vector<NodeId> parameters, bool constrained)
{
    std::ranges::sort(parameters);
    const auto [found, is_new] = there_.try_emplace({constrained, parameters});
    There& there = found->second;
    if (!is_new) return there;
    there.setting = setting_;
    if (!constrained) there.setting.constraints.clear();
    for (const NodeId parameter : parameters) std::erase(there.setting.parameters, parameter);
    const Replacements values = values_of(parameters);
    for (auto* nodes : {&there.setting.constraints, &there.setting.domain, &there.setting.defined}) {
        auto moved = substitute_where_defined(*graph_, *nodes, values);
        if (!moved) return there;
        *nodes = std::move(*moved);
        std::erase_if(*nodes, [&](NodeId node) { return graph_->is_constant(node); });
    }
    there.decider = ZeroDecider::make(*graph_, there.setting, budget_of_a_rule());
    return there;
}

const std::vector<NamedNumbers>& Prover::points()
{
    if (points_) return *points_;
    std::vector<NodeId> all;
    for (const auto& [parameter, value] : values_) all.push_back(parameter);
    const There& there = where(all);
    points_ = there.decider ? generic_points(*graph_, there.setting, 3) : std::vector<NamedNumbers>();
    for (NamedNumbers& point : *points_) point.merge(parameter_numbers());
    return *points_;
}

NamedNumbers Prover::parameter_numbers() const
{
    NamedNumbers numbers;
    for (const auto& [parameter, value] : values_)
        numbers[graph_->input_name(parameter)] = evaluate<long double>(*graph_, std::vector{value}, {})[0];
    return numbers;
}

std::vector<NamedPoint> Prover::exact_points(std::size_t count)
{
    std::vector<NodeId> all;
    for (const auto& [parameter, value] : values_) all.push_back(parameter);
    std::vector<NamedPoint> points;
    for (std::size_t seed = 0; points.size() < count && seed < 2 * count; ++seed) {
        ProofBudget budget = budget_of_a_rule();
        budget.seed = seed;
        const auto decider = ZeroDecider::make(*graph_, where(all).setting, budget);
        const std::optional<NamedPoint> point = decider ? decider->sample_point() : std::nullopt;
        if (point && std::ranges::all_of(*point, [](const auto& each) { return each.second.exact.has_value(); }))
            points.push_back(*point);
    }
    return points;
}

std::optional<NodeId> Prover::normal_form(NodeId function)
{
    const There& there = where(bound_);
    if (!there.decider) return std::nullopt;
    const Decision decision = there.decider->decide(function);
    if (decision.status == ProofStatus::proved) return graph_->constant(0);
    if (!decision.normal_form) return std::nullopt;
    return Lowering(*graph_)(decision.normal_form);
}

bool Prover::is_plainly_nonzero(NodeId function)
{
    if (graph_->is_constant(function)) return !graph_->is_zero(function);
    return std::ranges::any_of(points(), [&](const NamedNumbers& point) {
        return std::abs(evaluate<long double>(*graph_, std::vector{function}, point)[0]) > 1e-9L;
    });
}

bool Prover::proves(const std::vector<NodeId>& functions, const std::vector<NodeId>& parameters, bool constrained)
{
    There& there = where(parameters, constrained);
    if (!there.decider) return false;
    const auto moved = substitute_where_defined(*graph_, functions, values_of(parameters));
    return moved && std::ranges::all_of(*moved, [&](NodeId function) {
               return graph_->is_zero(function) || there.decider->status(function) == ProofStatus::proved;
           });
}

std::optional<std::vector<NodeId>> Prover::vanishing(const std::vector<NodeId>& functions)
{
    return vanishing(functions, true);
}

std::optional<std::vector<NodeId>> Prover::unchanging(std::vector<NodeId> functions, const Replacements& direction)
{
    std::vector<NodeId> moved;
    for (const auto& [input, rate] : direction) moved.push_back(input);
    const std::vector<bool> depends = depends_on(*graph_, moved);
    for (const NodeId node : reachable(*graph_, functions))
        if (depends[node] && has_branches(graph_->op(node)))
            for (const NodeId operand : graph_->operands(node)) functions.push_back(operand);
    return vanishing(directional(*graph_, functions, direction), false);
}

std::optional<std::vector<NodeId>> Prover::vanishing(const std::vector<NodeId>& functions, bool constrained)
{
    std::vector<NodeId> open;
    for (const NodeId function : with_relations(functions))
        if (!graph_->is_zero(function)) open.push_back(function);
    if (open.empty()) return std::vector<NodeId>();
    if (std::ranges::any_of(open, [&](NodeId function) { return is_plainly_nonzero(function); })) return std::nullopt;
    if (proves(open, bound_, constrained)) return std::vector<NodeId>();
    std::vector<NodeId> needed;
    for (const auto& [parameter, value] : values_)
        if (std::ranges::find(bound_, parameter) == bound_.end() &&
            depends_on_any(*graph_, open, std::vector{parameter}))
            needed.push_back(parameter);
    const auto with = [&](std::vector<NodeId> parameters) {
        parameters.insert(parameters.end(), bound_.begin(), bound_.end());
        return parameters;
    };
    if (needed.empty() || !proves(open, with(needed), constrained)) return std::nullopt;
    for (const NodeId parameter : std::vector<NodeId>(needed)) {
        std::vector<NodeId> fewer = needed;
        std::erase(fewer, parameter);
        if (proves(open, with(fewer), constrained)) needed = std::move(fewer);
    }
    return needed;
}

bool Prover::vanishes_nowhere(NodeId function)
{
    const std::vector<NodeId> there = with_relations({function});
    if (graph_->is_constant(there[0])) return !graph_->is_zero(there[0]);
    return where(bound_).decider && where(bound_).decider->proves_nonzero(there[0]);
}

std::optional<NamedPoint> Prover::sample_point()
{
    const There& there = where(bound_);
    return there.decider ? there.decider->sample_point() : std::nullopt;
}

void Prover::bind(const std::vector<NodeId>& parameters)
{
    for (const NodeId parameter : parameters)
        if (std::ranges::find(bound_, parameter) == bound_.end()) bound_.push_back(parameter);
}

std::vector<NodeId> Prover::with_relations(const std::vector<NodeId>& functions)
{
    return substitute(*graph_, functions, values_of(bound_));
}

void Prover::forget()
{
    there_.clear();
    points_.reset();
}

bool Prover::restrict_to(const Replacements& replacements, const std::vector<NodeId>& constants,
                         const std::vector<NodeId>& variables)
{
    ProofSetting setting = setting_;
    for (auto* nodes : {&setting.constraints, &setting.domain, &setting.defined}) {
        auto moved = substitute_where_defined(*graph_, *nodes, replacements);
        if (!moved) return false;
        *nodes = std::move(*moved);
        std::erase_if(*nodes, [&](NodeId node) { return graph_->is_constant(node); });
    }
    for (const auto& [input, value] : replacements) std::erase(setting.variables, input);
    for (const NodeId constant : constants) {
        std::erase(setting.variables, constant);
        setting.parameters.push_back(constant);
    }
    setting.variables.insert(setting.variables.begin(), variables.begin(), variables.end());
    setting_ = std::move(setting);
    forget();
    return true;
}

} // namespace lagen
