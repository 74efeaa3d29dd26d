// SPDX-License-Identifier: GPL-2.0-or-later
/// Sections that are claimed to be symmetries: of L, else of H, and of a discrete L that is written out. (That of a
/// scheme is as symmetric as its curves; a run measures what it keeps.)
#include "mechanics/symmetry.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/claims.hpp"

namespace lagen {

void Claims::decide_symmetries(StructureReport& structure)
{
    if (system_.symmetries.empty()) return;
    const auto append = [&](Check check, const char* hint) {
        if (check.decision.status == ProofStatus::refuted) check.hint = hint;
        structure.checks.push_back(std::move(check));
    };
    const char* const rate = "the residual is the rate of the momentum p_a s^a along motions without forces";
    WhereConstant where = along_anchor();
    for (const SymmetryClaim& claim : system_.symmetries) {
        if (lagrangian_ || system_.hamiltonian) {
            const NodeId change = lagrangian_ ? lift_of_lagrangian(graph_, system_, *lagrangian_, claim.s)
                                              : lift_of_hamiltonian(graph_, system_, claim.s);
            Check check{"symmetry", {claim.name}, judge_->decide(change)};
            const NodeId momentum = contraction(graph_, lagrangian_ ? lagrangian_->fibre.momenta : system_.mu, claim.s);
            if (check.decision.status == ProofStatus::proved)
                if (WhereConstant::Conditions found = where.of({momentum}); found.obstacle.empty())
                    check.where = std::move(found.texts);
            append(std::move(check), rate);
        }
        if (!system_.discrete || !system_.discrete->written) continue;
        const NodeId residual = lift_of_discrete_lagrangian(graph_, system_, claim.s);
        Check steps{"symmetry", {claim.name}, decide_on_arrows(graph_, system_, residual, judge_->decider().budget())};
        if (lagrangian_ || system_.hamiltonian) steps.indices.emplace_back("discrete");
        steps.meaning = "the derivative of the discrete Lagrangian along the complete lift of " + claim.name;
        append(std::move(steps), "the residual is the change of the momentum p_a s^a over a step without forces");
    }
}

} // namespace lagen
