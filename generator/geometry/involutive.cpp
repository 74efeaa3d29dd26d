// SPDX-License-Identifier: GPL-2.0-or-later
/// Involutivity of a subbundle, pair by pair: its anchor equations say it, row by row.
#include "geometry/verify.hpp"

namespace lagen {
namespace {

/// The check of one pair from those of its anchor equations; nothing where all are zero by structure.
std::optional<Check> involutivity_of(const VerifiedAlgebroid& verified, const std::string& a, const std::string& b)
{
    std::optional<Check> result;
    for (const Check& check : verified.checks) {
        if (check.name != "anchor" || check.indices[0] != a || check.indices[1] != b) continue;
        const ProofStatus status = check.decision.status;
        const bool worse = result && (status == ProofStatus::refuted || result->decision.status == ProofStatus::proved);
        if (!result || (worse && result->decision.status != ProofStatus::refuted))
            result = Check{"involutive", {a, b}, check.decision, {}, {}};
        if (status == ProofStatus::refuted && result->hint.empty())
            result->hint = "[" + a + ", " + b + "] leaves the distribution along " + check.indices[2] +
                           ": a subbundle needs [rho(" + a + "), rho(" + b + ")] in the span of its sections";
    }
    return result;
}

} // namespace

void append_involutive(VerifiedAlgebroid& verified, const Model& model)
{
    if (model.algebroid.kind != AlgebroidKind::subbundle) return;
    const std::vector<Symbol>& fibre = verified.algebroid.fibre;
    std::vector<Check> checks;
    for (std::size_t a = 0; a < fibre.size(); ++a)
        for (std::size_t b = a + 1; b < fibre.size(); ++b)
            if (auto check = involutivity_of(verified, fibre[a].name, fibre[b].name))
                checks.push_back(*std::move(check));
    verified.checks.insert(verified.checks.end(), checks.begin(), checks.end());
}

} // namespace lagen
