// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/motion_divisors.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/operators.hpp"

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
        const Sense sense = known_where_defined(graph_, node);
        if (sense == Sense::nonzero || sense == Sense::positive) require_nonzero(condition_of(graph_, node));
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
        const Op op = graph_.op(term);
        const OpKind kind = kind_of(op);
        if (kind == OpKind::sum) {
            std::ranges::for_each(operands, add);
        } else if (kind == OpKind::quotient) {
            if (!depends_on_y(operands[1])) add(operands[0]);
        } else if (kind == OpKind::product) {
            for (const std::size_t k : {0U, 1U})
                if (!depends_on_y(operands[k]) && decider_->proves_nonzero(operands[k])) add(operands[1 - k]);
        } else if (op == Op::sqrt) {
            roots.insert(roots.end(), count, term);
        }
    }
    return roots;
}

/// Is everything in L, but for this root, smooth in these coordinates wherever it is?
bool MotionDivisors::is_smooth_but_for(NodeId root, NodeId lagrangian, const std::vector<NodeId>& y)
{
    const std::vector<NodeId> needed = reachable(graph_, std::vector<NodeId>{lagrangian});
    return std::ranges::all_of(needed, [&](NodeId node) {
        const auto moves = [&](NodeId f) { return depends_on_any(graph_, std::vector<NodeId>{f}, y); };
        if (node == root) return true;
        switch (smooth_where(graph_, node)) {
        case Sense::always: return true;
        case Sense::nonzero:
        case Sense::nonnegative:
        case Sense::positive: return !moves(graph_.op(node) == Op::real_power ? node : condition_of(graph_, node));
        case Sense::off_origin:
        case Sense::off_cut:
        case Sense::same_branch:
        case Sense::regular: break;
        }
        return !moves(node);
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
    const Operator& row = operator_of(graph_.op(divisor));
    if (row.vanishes_with_operand)
        require_nonzero(graph_.operands(divisor)[0]);
    else if (row.kind == OpKind::product)
        for (const NodeId operand : graph_.operands(divisor)) require_nonzero(operand);
}

bool MotionDivisors::nonzero(NodeId f) const
{
    if (divisors_.contains(f)) return true;
    const auto operands = graph_.operands(f);
    const Operator& row = operator_of(graph_.op(f));
    if (row.vanishes_with_operand && nonzero(operands[0])) return true;
    if (row.kind == OpKind::product && nonzero(operands[0]) && nonzero(operands[1])) return true;
    return decider_->proves_nonzero(f);
}

bool MotionDivisors::positive(NodeId f) const
{
    return (divisors_.contains(f) && decider_->proves_nonnegative(f)) || decider_->proves_positive(f);
}

} // namespace lagen
