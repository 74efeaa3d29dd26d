// SPDX-License-Identifier: GPL-2.0-or-later
/// Involutivity of a subbundle, pair by pair: its anchor equations say it, row by row.
#include "verify/verify.hpp"

namespace lagen {
namespace {

/// The check of one pair from those of its anchor equations; nothing where all are zero by structure.
std::optional<Check> involutivity_of(const StructureReport& structure, const std::string& a, const std::string& b)
{
    std::optional<Check> result;
    for (const Check& check : structure.checks) {
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

void append_involutive(StructureReport& structure, const System& system)
{
    if (!system.is_distribution) return;
    const std::vector<NodeId>& y = system.algebroid.y;
    const auto name_of = [&](std::size_t a) { return system.graph.input_name(y[a]); };
    std::vector<Check> checks;
    for (std::size_t a = 0; a < y.size(); ++a)
        for (std::size_t b = a + 1; b < y.size(); ++b)
            if (auto check = involutivity_of(structure, name_of(a), name_of(b))) checks.push_back(*std::move(check));
    structure.checks.insert(structure.checks.end(), checks.begin(), checks.end());
}

} // namespace lagen
