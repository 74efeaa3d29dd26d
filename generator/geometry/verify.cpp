// SPDX-License-Identifier: GPL-2.0-or-later
/// Every check that a model calls for, decided on one graph under one setting.
#include "geometry/verify.hpp"
#include "geometry/claims.hpp"

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

} // namespace

VerifiedAlgebroid verify(const Model& model, const std::vector<NamedTree>& extra_invariants)
{
    VerifiedAlgebroid verified;
    verified.algebroid = build_algebroid(model);
    Claims claims(model, verified.algebroid);
    claims.decide_structure(verified);
    claims.decide_surfaces(verified);
    claims.decide_regularity(verified);
    claims.decide_invariants(verified, extra_invariants);
    verified.verdict = verdict_of(verified);
    return verified;
}

} // namespace lagen
