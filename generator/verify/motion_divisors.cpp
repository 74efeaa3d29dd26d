// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/motion_divisors.hpp"

#include "graph/differentiate.hpp"
#include "graph/smoothness.hpp"

#include <algorithm>
#include <functional>
#include <map>

namespace lagen {

MotionDivisors::MotionDivisors(Graph& graph, const ProofSetting& setting, const ProofBudget& budget)
    : graph_(graph), variables_(setting.variables), decider_(std::make_unique<ZeroDecider>(graph, setting, budget))
{
    collect(setting.defined);
}

/// The divisors of what is defined all along a motion; what stands in one branch only says nothing.
void MotionDivisors::collect(const std::vector<NodeId>& motion)
{
    const std::vector<NodeId> needed = certainly_needed(graph_, motion);
    certain_.insert(needed.begin(), needed.end());
    for (const NodeId node : needed) {
        const std::vector<NodeId> operands(graph_.operands(node).begin(), graph_.operands(node).end());
        const Op op = graph_.op(node);
        if (op == Op::divide) require_nonzero(operands[1]);
        if (op == Op::log) require_nonzero(operands[0]);
        if (op == Op::power && static_cast<std::int32_t>(graph_.payload(node)) < 0) require_nonzero(operands[0]);
        if (op == Op::real_power && graph_.is_constant(operands[1]) && sgn(graph_.value(operands[1])) < 0)
            require_nonzero(operands[0]);
        if (op == Op::tan) require_nonzero(graph_.apply(Op::cos, operands[0]));
    }
}

/// The roots sqrt(g) in L = a sqrt(g) + .. with a != 0 free of y, once for each such term.
std::vector<NodeId> MotionDivisors::linear_roots(NodeId lagrangian, const std::vector<NodeId>& y) const
{
    const auto depends_on_y = [&](NodeId node) { return depends_on_any(graph_, std::vector<NodeId>{node}, y); };
    // How often a term stands in L, once or more; operands come before their node, so the greatest is complete.
    std::map<NodeId, std::size_t, std::greater<>> terms = {{lagrangian, 1}};
    std::vector<NodeId> roots;
    while (!terms.empty()) {
        const auto [term, count] = *terms.begin();
        terms.erase(terms.begin());
        const auto operands = graph_.operands(term);
        const auto add = [&terms, times = count](NodeId node) {
            std::size_t& known = terms[node];
            known = std::min<std::size_t>(known + times, 2);
        };
        switch (graph_.op(term)) {
        case Op::add:
        case Op::subtract:
        case Op::negate: std::ranges::for_each(operands, add); break;
        case Op::divide:
            if (!depends_on_y(operands[1])) add(operands[0]);
            break;
        case Op::multiply:
            for (const std::size_t k : {0U, 1U})
                if (!depends_on_y(operands[k]) && decider_->proves_nonzero(operands[k])) add(operands[1 - k]);
            break;
        case Op::sqrt: roots.insert(roots.end(), count, term); break;
        default: break;
        }
    }
    return roots;
}

/// Is everything in L, but for this root, smooth in these coordinates wherever it is?
bool MotionDivisors::is_smooth_but_for(NodeId root, NodeId lagrangian, const std::vector<NodeId>& y)
{
    const std::vector<NodeId> needed = reachable(graph_, std::vector<NodeId>{lagrangian});
    return std::ranges::all_of(needed, [&](NodeId node) {
        const Op op = graph_.op(node);
        const bool whole = op == Op::atan2 || op == Op::factor || op == Op::select || op == Op::real_power;
        const SmoothWhere where = smooth_where(graph_, node);
        if (node == root || (!whole && where.condition == SmoothWhere::Condition::none)) return true;
        return !depends_on_any(graph_, std::vector<NodeId>{whole ? node : where.function}, y);
    });
}

/// dL/dy is infinite where g = 0 and dg/dy != 0 if L = a sqrt(g) + (what is smooth in the y of g); both vanish only
/// where g - y^a dg/dy^a / 2 does.
void MotionDivisors::keep_momenta_finite(NodeId lagrangian, const std::vector<NodeId>& y)
{
    const std::vector<NodeId> roots = linear_roots(lagrangian, y);
    for (const NodeId root : roots) {
        const std::vector<NodeId> g = {graph_.operands(root)[0]};
        std::vector<NodeId> own = y;
        std::erase_if(own, [&](NodeId v) { return !depends_on_any(graph_, g, std::vector<NodeId>{v}); });
        if (own.empty() || std::ranges::count(roots, root) != 1 || !is_smooth_but_for(root, lagrangian, own)) continue;
        std::vector<NodeId> terms;
        const std::vector<NodeId> slope = gradient(graph_, g[0], own);
        for (std::size_t a = 0; a < own.size(); ++a) terms.push_back(graph_.multiply(own[a], slope[a]));
        const NodeId half = graph_.divide(graph_.sum(terms), graph_.constant(2));
        if (decider_->proves_nonzero(graph_.subtract(g[0], half))) require_nonzero(root);
    }
}

bool MotionDivisors::moves(NodeId node) const
{
    return depends_on_any(graph_, std::vector<NodeId>{node}, variables_);
}

void MotionDivisors::require_nonzero(NodeId divisor)
{
    if (!divisors_.insert(divisor).second) return;
    const Op op = graph_.op(divisor);
    const bool vanishes_with_operands =
        op == Op::multiply || op == Op::negate || op == Op::power || op == Op::sqrt || op == Op::abs || op == Op::sign;
    if (op == Op::divide)
        require_nonzero(graph_.operands(divisor)[0]);
    else if (vanishes_with_operands)
        for (const NodeId operand : graph_.operands(divisor)) require_nonzero(operand);
}

bool MotionDivisors::nonzero(NodeId f) const
{
    if (divisors_.contains(f)) return true;
    const auto operands = graph_.operands(f);
    switch (graph_.op(f)) {
    case Op::multiply:
        if (nonzero(operands[0]) && nonzero(operands[1])) return true;
        break;
    case Op::divide:
    case Op::negate:
    case Op::power:
    case Op::sqrt:
    case Op::abs:
        if (nonzero(operands[0])) return true;
        break;
    default: break;
    }
    return decider_->proves_nonzero(f);
}

bool MotionDivisors::positive(NodeId f) const
{
    return (divisors_.contains(f) && decider_->proves_nonnegative(f)) || decider_->proves_positive(f);
}

} // namespace lagen
