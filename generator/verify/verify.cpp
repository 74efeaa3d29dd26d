// SPDX-License-Identifier: GPL-2.0-or-later
/// Every check that a system calls for, decided on one graph under one setting.
#include "verify/verify.hpp"
#include "text/activity.hpp"
#include "verify/claims.hpp"

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

Verdict verdict_of(const StructureReport& structure)
{
    Verdict verdict = structure.note.empty() ? Verdict::valid : Verdict::undecided;
    for (const Check& check : structure.checks) {
        if (check.decision.status == ProofStatus::refuted) return Verdict::invalid;
        if (check.decision.status == ProofStatus::undecided) verdict = Verdict::undecided;
    }
    return verdict;
}

Report verify(const System& system, const std::vector<NamedTree>& extra_invariants, const ProofBudget& budget)
{
    Report report;
    const Activity whole("deciding " + system.name);
    std::optional<Activity> activity(std::in_place, "divisors");
    Claims claims(system, budget);
    activity.emplace("structure equations");
    claims.decide_structure(report.structure);
    append_involutive(report.structure, system);
    activity.emplace("groupoid and forms");
    claims.decide_groupoid(report.structure);
    claims.decide_forms(report.structure);
    activity.emplace("regularity");
    report.mechanics.regularity = claims.decide_regularity();
    report.mechanics.discrete = claims.decide_discrete_regularity();
    activity.emplace("distribution");
    claims.decide_distribution(report);
    activity.emplace("Legendre transform, symmetries, Hamilton-Jacobi equation");
    claims.decide_legendre(report.structure);
    claims.decide_symmetries(report.structure);
    claims.decide_hamilton_jacobi(report.structure, report.mechanics.regularity);
    activity.emplace("invariants");
    claims.decide_invariants(report, extra_invariants);
    activity.emplace("controls");
    claims.decide_controls(report);
    report.structure.verdict = verdict_of(report.structure);
    return report;
}

bool rests_on_values(const Regularity& known)
{
    return known.kind == Regularity::Kind::generically_regular || known.kind == Regularity::Kind::undecided ||
           known.for_given_parameters || !known.legendre_obstacle.empty() || !known.legendre_values.empty();
}

Regularity verify_regularity(const System& system)
{
    return Claims(system, {}).decide_regularity();
}

} // namespace lagen
