// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/jumps.hpp"

#include "graph/core/operators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lagen {

Continuity::Continuity(Graph& graph, const ProofSetting& setting, const ProofBudget& budget, Conserved conserved)
    : graph_(graph), motion_(setting.defined), divisors_(graph, setting, budget), conserved_(std::move(conserved))
{
}

/// Where the motion has kinks, quotients are not taken to be safe.
void Continuity::classify_motion()
{
    const Conserved conserved = std::exchange(conserved_, {}); // of claims
    for (const NodeId node : motion_) {
        const Course course = along(node).course;
        analytic_motion_ = analytic_motion_ && (course == Course::analytic || course == Course::quotient);
    }
    conserved_ = conserved;
    motion_.clear();
    along_.clear();
}

/// Off the zeros of its condition, or for good where that does not move. Of functions that have one.
bool Continuity::is_smooth(NodeId node)
{
    switch (smooth_where(graph_, node)) {
    case Sense::always: return true;
    case Sense::nonzero: return divisors_.keeps_nonzero(condition_of(graph_, node));
    case Sense::nonnegative:
    case Sense::positive: return divisors_.positive(condition_of(graph_, node));
    case Sense::off_origin:
    case Sense::off_cut:
    case Sense::same_branch:
    case Sense::regular: break;
    }
    return false;
}

Continuity::Along Continuity::jumping(NodeId node, NodeId hole) const
{
    return {Course::jumps, hole,
            fmt::format("{} may jump where {} vanishes", to_text(graph_, node, 80), to_text(graph_, hole, 60)), false};
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
        result = {mixes ? Course::sum : std::max(result.course, term.course), hole, {}, false};
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

Continuity::Along Continuity::reciprocal(NodeId divisor, const Along& below, NodeId node)
{
    if (below.course == Course::jumps) return below;
    if (below.course <= Course::continuous && divisors_.keeps_nonzero(divisor)) return below;
    const bool is_quotient = below.course == Course::analytic || below.course == Course::quotient;
    if (!is_quotient || !analytic_motion_) return jumping(node, divisor);
    return {Course::quotient, divisor, {}, false};
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
    NodeId g = graph_.operands(node)[0]; // log|g| and log(sqrt(g)) are halves of log(g^2) and log(g)
    while (graph_.op(g) == Op::abs || graph_.op(g) == Op::sqrt) g = graph_.operands(g)[0];
    const Along& inner = along_.at(g);
    if (inner.course == Course::jumps) return inner;
    if (inner.course != Course::analytic || !analytic_motion_) return jumping(node, g);
    return {Course::quotient, g, {}, false};
}

Continuity::Along Continuity::angle(NodeId node)
{
    const NodeId v = graph_.operands(node)[0];
    const NodeId u = graph_.operands(node)[1];
    if (divisors_.nonzero(v) || divisors_.positive(u)) return smooth_function(node);
    const std::string text = to_text(graph_, node, 80);
    const std::string sine = to_text(graph_, v, 60);
    const std::string cosine = to_text(graph_, u, 60);
    return {Course::jumps, v,
            divisors_.nonnegative(u)
                ? fmt::format("{} may jump where {} and {} vanish", text, sine, cosine)
                : fmt::format("{} jumps by 2*pi where {} changes its sign and {} < 0", text, sine, cosine),
            false};
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
        return {Course::jumps, node, "the solution of linear equations may jump where their determinant vanishes",
                false};
    return {Course::quotient, node, {}, false};
}

Continuity::Along Continuity::step(NodeId node)
{
    const Along constant{Course::analytic, 0, {}, true};
    const std::vector<NodeId> operands(graph_.operands(node).begin(), graph_.operands(node).end());
    if (operands.empty()) return divisors_.moves(node) ? Along{} : constant;
    if (std::ranges::all_of(operands, [&](NodeId operand) { return along_.at(operand).constant; })) return constant;
    Along result = operation(node);
    if (result.course != Course::jumps || !conserved_) return result;
    // Of constants of the motion everything is one; proofs of that are asked for where it matters.
    const bool is_constant = std::ranges::all_of(operands, [&](NodeId operand) {
        Along& inner = along_.at(operand);
        if (!inner.constant && inner.course != Course::jumps) inner.constant = conserved_(operand);
        return inner.constant;
    });
    return is_constant ? constant : result;
}

Continuity::Along Continuity::operation(NodeId node)
{
    const std::vector<NodeId> operands(graph_.operands(node).begin(), graph_.operands(node).end());
    switch (kind_of(graph_.op(node))) {
    case OpKind::leaf: return {};
    case OpKind::sum: return add(node);
    case OpKind::product: return multiply(along_.at(operands[0]), along_.at(operands[1]), node);
    case OpKind::quotient:
        return multiply(along_.at(operands[0]), reciprocal(operands[1], along_.at(operands[1]), node), node);
    case OpKind::power: {
        const Along& inner = along_.at(operands[0]);
        const Along base = domain_of(graph_, node) == Sense::nonzero ? reciprocal(operands[0], inner, node) : inner;
        return multiply(base, base, node);
    }
    case OpKind::choice: {
        const Along& condition = along_.at(operands[0]);
        return condition.course == Course::jumps ? condition : add(node);
    }
    case OpKind::system: return solution(node);
    case OpKind::function:
    case OpKind::comparison: break;
    }
    return function(node);
}

Continuity::Along Continuity::function(NodeId node)
{
    switch (operator_of(graph_.op(node)).smoothness) {
    case Smoothness::meromorphic: { // over a function that vanishes at its poles
        const Along result = smooth_function(node);
        if (domain_of(graph_, node) == Sense::always) return result;
        return multiply(result, reciprocal(condition_of(graph_, node), result, node), node);
    }
    case Smoothness::analytic: return analytic_inside(node);
    case Smoothness::cut: return angle(node);
    case Smoothness::kinked: return kinked(node, is_smooth(node));
    case Smoothness::stepped:
        return is_smooth(node) ? smooth_function(node) : jumping(node, condition_of(graph_, node));
    case Smoothness::chosen:
    case Smoothness::system: break; // no functions
    }
    throw InternalError("a function that is a choice or a linear system");
}

/// Of a function that may end, continuous or not, where its condition vanishes.
Continuity::Along Continuity::analytic_inside(NodeId node)
{
    if (is_smooth(node)) return smooth_function(node);
    if (graph_.op(node) == Op::log) return logarithm(node);
    const bool exponent_stays = graph_.op(node) == Op::real_power && !graph_.is_constant(graph_.operands(node)[1]) &&
                                divisors_.is_defined(node) && !divisors_.moves(graph_.operands(node)[1]);
    const bool continuous = exponent_stays || domain_of(graph_, node) == Sense::nonnegative;
    return continuous ? kinked(node, false) : jumping(node, condition_of(graph_, node));
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
    if (!motion_.empty()) classify_motion();
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
