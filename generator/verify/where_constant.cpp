// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/where_constant.hpp"

#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "graph/core/operators.hpp"
#include "verify/singular_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lagen {
namespace {

constexpr std::size_t longest_named = 200; ///< characters of a condition

} // namespace

WhereConstant::WhereConstant(Graph& graph, const ProofSetting& setting, const ProofBudget& budget, Conserved conserved)
    : graph_(graph), setting_(setting), defined_(std::move(setting_.defined)), conserved_(std::move(conserved))
{
    setting_.defined.clear();
    drop_what_is_stepped_over();
    decider_ = std::make_unique<ZeroDecider>(graph, setting_, budget);
}

/// A run ends where it would leave f > 0; one of a header steps over f != 0, unless f has one sign and vanishes on
/// something smaller than a wall.
void WhereConstant::drop_what_is_stepped_over()
{
    ProofSetting open = setting_;
    std::erase_if(open.domain, [&](NodeId each) { return graph_.op(each) == Op::not_equal; });
    const auto decider = ZeroDecider::make(graph_, open, {});
    std::erase_if(setting_.domain, [&](NodeId each) {
        if (graph_.op(each) != Op::not_equal) return false;
        const NodeId f = condition_of(graph_, each);
        return !depends_only_on_parameters(f) && !decider->proves_nonnegative(f) &&
               !decider->proves_nonnegative(graph_.negate(f));
    });
}

bool WhereConstant::depends_only_on_parameters(NodeId f)
{
    const NodeId only[] = {f};
    return !depends_on_any(graph_, only, setting_.variables);
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
    case Smoothness::system: return require_defined(node);
    }
}

void WhereConstant::require_defined(NodeId node)
{
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

/// atan2(v, u): v != 0, or u > 0 where v is 0 everywhere. Of a v that stays 0 it jumps where u changes its sign, so
/// that constant factors of v count.
void WhereConstant::require_off_cut(NodeId node)
{
    const NodeId v = graph_.operands(node)[0], u = graph_.operands(node)[1];
    if (decider_->proves_nonzero(v) || decider_->proves_positive(u) || (is_conserved(v) && is_conserved(u))) return;
    if (graph_.is_zero(v) || decider_->status(v) == ProofStatus::proved) return require_positive(u);
    require_nonzero_factors(v, false);
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
    if (!decider_->proves_nonzero(f) && !is_conserved(f)) require_nonzero_factors(f, true);
}

/// A factor that stays what it is may be left out where nothing is claimed if it is 0.
void WhereConstant::require_nonzero_factors(NodeId f, bool but_conserved)
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
        else if (!decider_->proves_nonzero(factor) && !(but_conserved && is_conserved(factor)))
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
    if (decider_->proves_positive(f) || is_conserved(f)) return;
    if (decider_->proves_nonnegative(f)) return require_nonzero_factors(f, true);
    add(f, true);
}

/// By its factors, where they are short; else by its name.
void WhereConstant::require_divisor(const NamedNode& divisor)
{
    if (decider_->proves_nonzero(divisor.node)) return;
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
    setting.defined = defined_;
    setting.defined.insert(setting.defined.end(), functions.begin(), functions.end());
    const std::unique_ptr<ZeroDecider> there = ZeroDecider::make(graph_, setting, decider_->budget());
    return there && there->sample_point().has_value();
}

/// The shortest of f > 0 and -f < 0, as they are written and as normal forms.
std::string WhereConstant::text_of(const Condition& condition)
{
    const char* relations[] = {condition.positive ? " > 0" : " != 0", condition.positive ? " < 0" : " != 0"};
    if (!condition.name.empty()) return condition.name + relations[0];
    const NodeId sides[] = {condition.f, graph_.negate(condition.f)};
    std::string shortest = to_text(graph_, condition.f, longest_named);
    if (shortest.size() > longest_named) {
        obstacle_ = "it may change where " + shortest.substr(0, 60) + "... vanishes";
        return {};
    }
    const char* relation = relations[0];
    for (const std::size_t k : {0U, 1U})
        for (const std::string& text : {to_text(graph_, sides[k], longest_named), decider_->decide(sides[k]).residual})
            if (!text.empty() && text.size() < shortest.size()) {
                shortest = text;
                relation = relations[k];
            }
    return shortest + relation;
}

WhereConstant::Conditions WhereConstant::of(const std::vector<NodeId>& functions,
                                            const std::vector<NamedNode>& divisors)
{
    conditions_.clear();
    obstacle_.clear();
    for (const NodeId node : reachable(graph_, functions)) require(node);
    for (const NamedNode& divisor : divisors) require_divisor(divisor);
    return conditions(functions);
}

WhereConstant::Conditions WhereConstant::reaching(const std::vector<NodeId>& functions,
                                                  const std::vector<NodeId>& domain)
{
    conditions_.clear();
    obstacle_.clear();
    for (const NodeId node : reachable(graph_, functions)) require(node);
    for (const NodeId comparison : domain) {
        if (graph_.is_constant(comparison)) continue;
        const NodeId difference = condition_of(graph_, comparison);
        const Trichotomy holds = operator_of(graph_.op(comparison)).holds;
        if (holds.below && holds.above)
            require_nonzero(difference);
        else
            require_positive(holds.below ? graph_.negate(difference) : difference);
    }
    return conditions(functions);
}

WhereConstant::Conditions WhereConstant::conditions(const std::vector<NodeId>& functions)
{
    drop_implied();
    std::vector<std::string> texts;
    for (const Condition& condition : conditions_) {
        std::string text = text_of(condition);
        if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
    }
    if (!texts.empty() && obstacle_.empty() && !hold_somewhere(functions))
        obstacle_ = fmt::format("no point was found where {}", fmt::join(texts, " and "));
    return {std::move(texts), obstacle_};
}

void WhereConstant::restrict(Check& check, const Conditions& conditions)
{
    if (check.decision.status != ProofStatus::proved) return;
    if (conditions.obstacle.empty()) {
        check.where = conditions.texts;
        return;
    }
    check.decision.status = ProofStatus::undecided;
    check.decision.evidence = "its rate vanishes, but " + conditions.obstacle;
}

} // namespace lagen
