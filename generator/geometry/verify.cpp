// SPDX-License-Identifier: GPL-2.0-or-later
/// Every check that a model calls for, decided on one graph under one setting.
#include "geometry/verify.hpp"
#include "geometry/claims.hpp"

#include <algorithm>

namespace lagen {

const char* to_text(Verdict verdict)
{
    switch (verdict) {
    case Verdict::valid: return "valid";
    case Verdict::invalid: return "invalid";
    case Verdict::undecided: break;
    }
    return "undecided";
}

namespace {

Verdict verdict_of(const VerifiedAlgebroid& verified)
{
    Verdict verdict = verified.note.empty() ? Verdict::valid : Verdict::undecided;
    for (const Check& check : verified.checks) {
        if (check.decision.status == ProofStatus::refuted) return Verdict::invalid;
        if (check.decision.status == ProofStatus::undecided) verdict = Verdict::undecided;
    }
    return verdict;
}

std::optional<Reevaluation> summary_of(const VerifiedAlgebroid& verified, std::size_t points)
{
    if (points == 0) return std::nullopt;
    Reevaluation summary;
    summary.points = points;
    for (const Check& check : verified.checks) {
        if (check.decision.status != ProofStatus::proved || !check.reevaluation) continue;
        summary.points = std::min(summary.points, check.reevaluation->points);
        summary.bound = std::max(summary.bound, check.reevaluation->bound);
    }
    return summary;
}

} // namespace

void require_confirmed(const Check& check)
{
    if (check.decision.status != ProofStatus::proved || !check.reevaluation || !check.reevaluation->zero_excluded)
        return;
    std::string what = check.name;
    for (const std::string& index : check.indices) what += " " + index;
    std::string where;
    for (const auto& [name, value] : check.reevaluation->where)
        where += (where.empty() ? " at " : ", ") + name + " = " + value;
    throw InternalError("the residual of " + what + " was proved to be zero, and is certainly not zero" + where);
}

VerifiedAlgebroid verify(const Model& model, const std::vector<NamedTree>& extra_invariants, std::size_t points,
                         const ProofBudget& budget)
{
    VerifiedAlgebroid verified;
    verified.algebroid = build_algebroid(model);
    Claims claims(model, verified.algebroid, points, budget);
    claims.decide_structure(verified);
    append_involutive(verified, model);
    claims.decide_regularity(verified);
    claims.decide_legendre(verified);
    claims.decide_invariants(verified, extra_invariants);
    claims.decide_controls(verified);
    for (const Check& check : verified.checks) require_confirmed(check);
    verified.reevaluation = summary_of(verified, points);
    verified.verdict = verdict_of(verified);
    return verified;
}

} // namespace lagen
