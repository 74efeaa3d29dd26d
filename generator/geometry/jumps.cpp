// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/jumps.hpp"

#include "geometry/smoothness.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

Continuity::Continuity(Graph& graph, const ProofSetting& setting, const ProofBudget& budget)
    : graph_(graph), decider_(graph, setting, budget)
{
    collect_divisors(setting.defined);
    for (const NodeId node : setting.defined) {
        const Course course = along(node).course;
        analytic_motion_ = analytic_motion_ && (course == Course::analytic || course == Course::quotient);
    }
    along_.clear(); // where the motion has kinks, quotients are no longer safe
}

/// The divisors of what is defined all along a motion; what stands in one branch only says nothing.
void Continuity::collect_divisors(const std::vector<NodeId>& roots)
{
    std::set<NodeId> certain(roots.begin(), roots.end());
    const std::vector<NodeId> needed = reachable(graph_, roots);
    for (std::size_t k = needed.size(); k-- > 0;) {
        const NodeId node = needed[k];
        if (!certain.contains(node)) continue;
        const auto operands = graph_.operands(node);
        const bool branches = graph_.op(node) == Op::select;
        certain.insert(operands.begin(), branches ? operands.begin() + 1 : operands.end());
        if (graph_.op(node) == Op::divide) require_nonzero(operands[1]);
        if (graph_.op(node) == Op::log) require_nonzero(operands[0]);
        if (graph_.op(node) == Op::power && static_cast<std::int32_t>(graph_.payload(node)) < 0)
            require_nonzero(operands[0]);
    }
}

void Continuity::require_nonzero(NodeId divisor)
{
    if (!divisors_.insert(divisor).second) return;
    const Op op = graph_.op(divisor);
    const bool vanishes_with_operands =
        op == Op::multiply || op == Op::negate || op == Op::power || op == Op::sqrt || op == Op::abs || op == Op::sign;
    if (op == Op::divide)
        require_nonzero(graph_.operands(divisor)[0]);
    else if (vanishes_with_operands)
        for (const NodeId operand :
             std::vector<NodeId>(graph_.operands(divisor).begin(), graph_.operands(divisor).end()))
            require_nonzero(operand);
}

bool Continuity::nonzero(NodeId f) const
{
    if (divisors_.contains(f)) return true;
    switch (graph_.op(f)) {
    case Op::multiply: return nonzero(graph_.operands(f)[0]) && nonzero(graph_.operands(f)[1]);
    case Op::divide:
    case Op::negate:
    case Op::power:
    case Op::sqrt:
    case Op::abs: return nonzero(graph_.operands(f)[0]);
    default: return decider_.proves_nonzero(f);
    }
}

bool Continuity::positive(NodeId f) const
{
    return decider_.proves_positive(f) || (divisors_.contains(f) && decider_.proves_nonnegative(f));
}

/// Except at zeros of divisors and of cosines, which are poles and no kinks.
bool Continuity::is_smooth(NodeId node)
{
    const Op op = graph_.op(node);
    if (op == Op::divide || op == Op::power || op == Op::tan) return true;
    const SmoothWhere where = smooth_where(graph_, node);
    if (where.condition == SmoothWhere::Condition::none) return true;
    return where.condition == SmoothWhere::Condition::positive ? positive(where.function) : nonzero(where.function);
}

Continuity::Along Continuity::jumping(NodeId node, NodeId hole) const
{
    return {Course::jumps, hole,
            fmt::format("{} may jump where {} vanishes", to_text(graph_, node, 80), to_text(graph_, hole, 60))};
}

Continuity::Along Continuity::add(NodeId node) const
{
    Along result;
    for (const NodeId operand : graph_.operands(node)) {
        const Along& term = along_.at(operand);
        if (term.course == Course::jumps) return term;
        const bool mixes = (result.course == Course::continuous && term.course == Course::quotient) ||
                           (result.course == Course::quotient && term.course == Course::continuous);
        const NodeId hole = term.course > Course::continuous ? term.hole : result.hole;
        result = {mixes ? Course::sum : std::max(result.course, term.course), hole, {}};
    }
    return result;
}

/// analytic (quotient + continuous) is of that kind again; what is continuous need not be small where a quotient is
/// large.
Continuity::Along Continuity::multiply(const Along& a, const Along& b, NodeId node) const
{
    if (a.course == Course::jumps) return a;
    if (b.course == Course::jumps) return b;
    const auto& [less, more] = std::minmax(a, b, [](const Along& p, const Along& q) { return p.course < q.course; });
    const bool remains = less.course == Course::analytic || (less.course == more.course && more.course != Course::sum);
    return remains ? more : jumping(node, more.hole);
}

Continuity::Along Continuity::reciprocal(NodeId divisor, NodeId node)
{
    const Along below = along_.at(divisor);
    if (below.course == Course::jumps) return below;
    if (below.course <= Course::continuous && nonzero(divisor)) return below;
    const bool is_quotient = below.course == Course::analytic || below.course == Course::quotient;
    if (!is_quotient || !analytic_motion_) return jumping(node, divisor);
    return {Course::quotient, divisor, {}};
}

/// Of what is analytic on the whole line.
Continuity::Along Continuity::smooth_function(NodeId node) const
{
    Along result;
    for (const NodeId operand : graph_.operands(node)) {
        const Along& inner = along_.at(operand);
        if (inner.course == Course::jumps) return inner;
        if (inner.course > Course::continuous) return jumping(node, inner.hole);
        result.course = std::max(result.course, inner.course);
    }
    return result;
}

/// Of a function that is continuous where it is defined, and analytic where it is `smooth`.
Continuity::Along Continuity::kinked(NodeId node, bool smooth) const
{
    Along result = smooth_function(node);
    if (result.course == Course::analytic && !smooth) result.course = Course::continuous;
    return result;
}

/// A logarithm is transcendental over quotients of analytic functions, and log(g) differs from a multiple of log|t| by
/// such a one where g vanishes at t = 0 and is positive on both sides: rational expressions in both are constant on
/// both sides or on none.
Continuity::Along Continuity::logarithm(NodeId node) const
{
    const NodeId g = graph_.operands(node)[0];
    const Along& inner = along_.at(g);
    if (inner.course == Course::jumps) return inner;
    if (inner.course != Course::analytic || !analytic_motion_) return jumping(node, g);
    return {Course::quotient, g, {}};
}

Continuity::Along Continuity::angle(NodeId node)
{
    const NodeId v = graph_.operands(node)[0];
    const NodeId u = graph_.operands(node)[1];
    if (nonzero(v) || positive(u)) return smooth_function(node);
    return {Course::jumps, v,
            fmt::format("{} jumps by 2*pi where {} changes its sign and {} < 0", to_text(graph_, node, 80),
                        to_text(graph_, v, 60), to_text(graph_, u, 60))};
}

/// Entries of A^-1 b: quotients with the determinant of A.
Continuity::Along Continuity::solution(NodeId node)
{
    const Op op = graph_.op(node);
    if (op == Op::component) return along_.at(graph_.operands(node)[0]);
    Along result;
    for (const NodeId operand : graph_.operands(node)) {
        result = multiply(result, along_.at(operand), node);
        if (result.course == Course::jumps) return result;
    }
    const bool regular = static_cast<MatrixStructure>(graph_.payload(node)) == MatrixStructure::positive_definite;
    if (op == Op::solve || regular) return result;
    if (result.course != Course::analytic || !analytic_motion_)
        return {Course::jumps, node, "the solution of linear equations may jump where their determinant vanishes"};
    return {Course::quotient, node, {}};
}

Continuity::Along Continuity::step(NodeId node)
{
    const std::vector<NodeId> operands(graph_.operands(node).begin(), graph_.operands(node).end());
    const bool smooth = is_smooth(node);
    switch (graph_.op(node)) {
    case Op::constant:
    case Op::pi:
    case Op::input: return {};
    case Op::add:
    case Op::subtract:
    case Op::negate: return add(node);
    case Op::multiply: return multiply(along_.at(operands[0]), along_.at(operands[1]), node);
    case Op::divide: return multiply(along_.at(operands[0]), reciprocal(operands[1], node), node);
    case Op::power: {
        const Along base = static_cast<std::int32_t>(graph_.payload(node)) < 0 ? reciprocal(operands[0], node)
                                                                               : along_.at(operands[0]);
        return multiply(base, base, node);
    }
    case Op::sin:
    case Op::cos:
    case Op::sinh:
    case Op::cosh:
    case Op::tanh:
    case Op::atan:
    case Op::exp:
    case Op::stumpff: return smooth_function(node);
    case Op::tan: {
        const NodeId below = graph_.apply(Op::cos, operands[0]);
        along_[below] = smooth_function(node);
        return multiply(along_.at(operands[0]), reciprocal(below, node), node);
    }
    case Op::log: return smooth ? smooth_function(node) : logarithm(node);
    case Op::real_power: {
        const bool rises = graph_.is_constant(operands[1]) && sgn(graph_.value(operands[1])) > 0;
        return smooth || rises ? kinked(node, smooth) : jumping(node, operands[0]);
    }
    case Op::sqrt:
    case Op::asin:
    case Op::acos:
    case Op::abs:
    case Op::minimum:
    case Op::maximum: return kinked(node, smooth);
    case Op::atan2: return angle(node);
    case Op::sign:
    case Op::less:
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
    case Op::equal:
    case Op::not_equal: return smooth ? smooth_function(node) : jumping(node, smooth_where(graph_, node).function);
    case Op::select: {
        const Along condition = along_.at(operands[0]);
        return condition.course == Course::jumps ? condition : add(node);
    }
    case Op::factor:
    case Op::solve:
    case Op::component: return solution(node);
    }
    return {};
}

const Continuity::Along& Continuity::along(NodeId f)
{
    const NodeId roots[] = {f};
    for (const NodeId node : reachable(graph_, roots))
        if (!along_.contains(node)) along_[node] = step(node);
    return along_.at(f);
}

std::string Continuity::jump_of(NodeId f)
{
    return along(f).jump;
}

void Continuity::respect_jumps(Decision& decision, NodeId f)
{
    if (decision.status != ProofStatus::proved) return;
    const std::string jump = jump_of(f);
    if (jump.empty()) return;
    decision.status = ProofStatus::undecided;
    decision.evidence = "its rate vanishes, but " + jump;
}

} // namespace lagen
