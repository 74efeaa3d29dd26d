// SPDX-License-Identifier: GPL-2.0-or-later
/// Involutivity of a subbundle, pair by pair: its anchor equations say it, row by row.
#include "verify/verify.hpp"

#include <algorithm>
#include <iterator>

namespace lagen {
namespace {

/// Whether `check` tells more than `known` of the same pair: refuted before undecided before proved.
bool is_worse(const Check& check, const Check& known)
{
    const ProofStatus status = check.decision.status, before = known.decision.status;
    return before != ProofStatus::refuted && (status == ProofStatus::refuted || before == ProofStatus::proved);
}

} // namespace

void append_involutive(StructureReport& structure, const System& system)
{
    if (!system.is_distribution) return;
    std::vector<Check> found;
    for (const Check& check : structure.checks) { // those of a pair stand together
        if (check.name != "anchor") continue;
        const std::vector<std::string> pair{check.indices[0], check.indices[1]};
        const bool known = !found.empty() && found.back().indices == pair;
        if (known && !is_worse(check, found.back())) continue;
        Check involutive{"involutive", pair, check.decision};
        if (check.decision.status == ProofStatus::refuted)
            involutive.hint = "[" + pair[0] + ", " + pair[1] + "] leaves the distribution along " + check.indices[2] +
                              ": a subbundle needs [rho(" + pair[0] + "), rho(" + pair[1] +
                              ")] in the span of its sections";
        if (known) found.pop_back();
        found.push_back(std::move(involutive));
    }
    std::ranges::move(found, std::back_inserter(structure.checks));
}

} // namespace lagen
