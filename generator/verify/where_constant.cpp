// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/where_constant.hpp"

#include "graph/calculus/determinant.hpp"
#include "graph/core/lower.hpp"
#include "graph/core/operators.hpp"
#include "verify/reduced_fraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lagen {
namespace {

constexpr std::size_t longest_named = 200; ///< characters of a condition

} // namespace

WhereConstant::WhereConstant(Graph& graph, const ProofSetting& setting, const ProofBudget& budget, Conserved conserved)
    : graph_(graph), setting_(setting), decider_(std::make_unique<ZeroDecider>(graph, setting, budget)),
      conserved_(std::move(conserved))
{
    // What stands in one branch only says nothing.
    const std::vector<NodeId> needed = certainly_needed(graph, setting.defined);
    certain_.insert(needed.begin(), needed.end());
    for (const NodeId node : needed) {
        const Sense sense = known_where_defined(graph_, node);
        if (sense == Sense::nonzero || sense == Sense::positive) know_nonzero(condition_of(graph_, node));
    }
}

/// With its factors.
void WhereConstant::know_nonzero(NodeId divisor)
{
    if (!nonzero_.insert(divisor).second) return;
    const Operator& row = operator_of(graph_.op(divisor));
    if (row.vanishes_with_operand)
        know_nonzero(graph_.operands(divisor)[0]);
    else if (row.kind == OpKind::product)
        for (const std::size_t k : {0U, 1U}) know_nonzero(graph_.operands(divisor)[k]);
}

/// All along every motion; false means "not shown".
bool WhereConstant::is_nonzero(NodeId f) const
{
    return nonzero_.contains(f) || decider_->proves_nonzero(f);
}

bool WhereConstant::is_positive(NodeId f) const
{
    return (nonzero_.contains(f) && decider_->proves_nonnegative(f)) || decider_->proves_positive(f);
}

bool WhereConstant::is_conserved(NodeId f)
{
    const auto known = known_conserved_.find(f);
    if (known != known_conserved_.end()) return known->second;
    return known_conserved_[f] = conserved_(f);
}

/// What the operation asks for, so that it is defined and does not jump.
void WhereConstant::require(NodeId node)
{
    switch (operator_of(graph_.op(node)).smoothness) {
    case Smoothness::cut: return require_off_cut(node);
    case Smoothness::stepped: return require_nonzero(condition_of(graph_, node));
    case Smoothness::kinked:
    case Smoothness::chosen: return; // its condition is a comparison
    case Smoothness::meromorphic:
    case Smoothness::analytic:
    case Smoothness::system: break;
    }
    if (certain_.contains(node)) return;
    switch (domain_of(graph_, node)) {
    case Sense::nonzero: return require_nonzero(condition_of(graph_, node));
    case Sense::nonnegative:
        if (const NodeId f = condition_of(graph_, node); !decider_->proves_nonnegative(f)) require_positive(f);
        return;
    case Sense::positive: return require_positive(condition_of(graph_, node));
    case Sense::regular: return require_regular(node);
    case Sense::always:
    case Sense::off_origin:
    case Sense::off_cut:
    case Sense::same_branch: break;
    }
}

/// atan2(v, u): v != 0, or u > 0 where v is 0 everywhere.
void WhereConstant::require_off_cut(NodeId node)
{
    const NodeId v = graph_.operands(node)[0], u = graph_.operands(node)[1];
    if (is_nonzero(v) || is_positive(u) || (is_conserved(v) && is_conserved(u))) return;
    if (graph_.is_zero(v) || decider_->status(v) == ProofStatus::proved) return require_positive(u);
    require_nonzero_factors(v);
}

void WhereConstant::require_regular(NodeId factor)
{
    const std::vector<NodeId> matrix(graph_.operands(factor).begin(), graph_.operands(factor).end());
    std::vector<std::size_t> all(static_cast<std::size_t>(std::lround(std::sqrt(matrix.size()))));
    std::iota(all.begin(), all.end(), 0);
    if (all.size() <= determinant_limit) return require_nonzero(determinant_of(graph_, matrix, all.size(), all, all));
    obstacle_ = "it may change where the determinant of its linear system vanishes, which is too large to be written";
}

void WhereConstant::require_nonzero(NodeId f)
{
    if (!is_nonzero(f) && !is_conserved(f)) require_nonzero_factors(f);
}

void WhereConstant::require_nonzero_factors(NodeId f)
{
    std::vector<NodeId> factors{f};
    while (!factors.empty()) {
        const NodeId factor = factors.back();
        factors.pop_back();
        const auto operands = graph_.operands(factor);
        const Operator& row = operator_of(graph_.op(factor));
        if (row.kind == OpKind::product)
            factors.insert(factors.end(), operands.rbegin(), operands.rend());
        else if (row.vanishes_with_operand)
            factors.push_back(operands[0]);
        else if (!is_nonzero(factor) && (factor == f || !is_conserved(factor)))
            add(factor, false);
    }
}

void WhereConstant::require_positive(NodeId f)
{
    if (graph_.op(f) == Op::multiply) {
        std::vector<NodeId> factors(graph_.operands(f).begin(), graph_.operands(f).end());
        if (graph_.is_constant(factors[1])) std::swap(factors[0], factors[1]);
        if (graph_.is_constant(factors[0]))
            return require_positive(sgn(graph_.value(factors[0])) > 0 ? factors[1] : graph_.negate(factors[1]));
    }
    if (is_positive(f) || is_conserved(f)) return;
    if (decider_->proves_nonnegative(f)) return require_nonzero_factors(f);
    add(f, true);
}

/// By its factors, where they are short; else by its name.
void WhereConstant::require_divisor(const NamedNode& divisor)
{
    if (is_nonzero(divisor.node)) return;
    const auto factors = factors_of(graph_, divisor.node, writing_order(graph_, setting_), *decider_);
    if (!factors) return add(divisor.node, false, divisor.name);
    for (const Tree& factor : *factors) require_nonzero(Lowering(graph_)(factor));
}

/// f > 0 takes the place of f != 0.
void WhereConstant::add(NodeId f, bool positive, const std::string& name)
{
    const auto known = std::ranges::find(conditions_, f, &Condition::f);
    if (known == conditions_.end())
        conditions_.push_back({f, positive, name});
    else
        known->positive = known->positive || positive;
}

ProofSetting WhereConstant::with_conditions_but(std::size_t left_out)
{
    ProofSetting setting = setting_;
    for (std::size_t k = 0; k < conditions_.size(); ++k) {
        const auto& [f, positive, name] = conditions_[k];
        if (k == left_out) continue;
        setting.domain.push_back(graph_.apply(positive ? Op::greater : Op::not_equal, f, graph_.constant(0)));
    }
    return setting;
}

/// Conditions that follow from the others.
void WhereConstant::drop_implied()
{
    for (std::size_t k = conditions_.size(); conditions_.size() > 1 && k-- > 0;) {
        const Condition condition = conditions_[k];
        const auto others = ZeroDecider::make(graph_, with_conditions_but(k), decider_->budget());
        if (others && (condition.positive ? others->proves_positive(condition.f) : others->proves_nonzero(condition.f)))
            conditions_.erase(conditions_.begin() + static_cast<std::ptrdiff_t>(k));
    }
}

bool WhereConstant::hold_somewhere(const std::vector<NodeId>& functions)
{
    ProofSetting setting = with_conditions_but(conditions_.size());
    setting.defined.insert(setting.defined.end(), functions.begin(), functions.end());
    const std::unique_ptr<ZeroDecider> there = ZeroDecider::make(graph_, setting, decider_->budget());
    return there && there->sample_point().has_value();
}

std::string WhereConstant::text_of(const Condition& condition)
{
    const bool below = condition.positive && graph_.op(condition.f) == Op::negate;
    const NodeId side = below ? graph_.operands(condition.f)[0] : condition.f;
    std::string f = condition.name.empty() ? to_text(graph_, side, longest_named) : condition.name;
    if (condition.name.empty() && f.size() <= longest_named)
        if (const std::string reduced = decider_->decide(side).residual; reduced.size() < f.size()) f = reduced;
    if (f.size() > longest_named) obstacle_ = "it may change where " + f.substr(0, 60) + "... vanishes";
    return f + (below ? " < 0" : condition.positive ? " > 0" : " != 0");
}

void WhereConstant::restrict(Check& check, const std::vector<NodeId>& functions, const std::vector<NamedNode>& divisors)
{
    if (check.decision.status != ProofStatus::proved) return;
    conditions_.clear();
    obstacle_.clear();
    for (const NodeId node : reachable(graph_, functions)) require(node);
    for (const NamedNode& divisor : divisors) require_divisor(divisor);
    drop_implied();
    std::vector<std::string> texts;
    for (const Condition& condition : conditions_) texts.push_back(text_of(condition));
    if (!texts.empty() && obstacle_.empty() && !hold_somewhere(functions))
        obstacle_ = fmt::format("no point was found where {}", fmt::join(texts, " and "));
    if (obstacle_.empty()) {
        check.where = std::move(texts);
        return;
    }
    check.decision.status = ProofStatus::undecided;
    check.decision.evidence = "its rate vanishes, but " + obstacle_;
}

} // namespace lagen
