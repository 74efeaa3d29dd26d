// SPDX-License-Identifier: GPL-2.0-or-later
/// Sections that are claimed to be symmetries: of L, else of H, and of a discrete L that is written out. (That of a
/// scheme is as symmetric as its curves; a run measures what it keeps.)
#include "mechanics/symmetry.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/claims.hpp"

namespace lagen {

void Claims::decide_symmetries(StructureReport& structure)
{
    const auto append = [&](std::vector<std::string> indices, NodeId residual, auto decide) {
        Check check{"symmetry", std::move(indices), decide(residual), {}, {}};
        if (check.decision.status == ProofStatus::refuted)
            check.hint = "the residual is the rate of the momentum p_a s^a along motions without forces";
        structure.checks.push_back(std::move(check));
    };
    for (const SymmetryClaim& claim : system_.symmetries) {
        const auto judge = [&](NodeId residual) { return judge_->decide(residual); };
        if (lagrangian_)
            append({claim.name}, lift_of_lagrangian(graph_, system_, *lagrangian_, claim.s), judge);
        else if (system_.hamiltonian)
            append({claim.name}, lift_of_hamiltonian(graph_, system_, claim.s), judge);
        if (system_.discrete && system_.discrete->written)
            append(lagrangian_ || system_.hamiltonian ? std::vector<std::string>{claim.name, "discrete"}
                                                      : std::vector<std::string>{claim.name},
                   lift_of_discrete_lagrangian(graph_, system_, claim.s), [&](NodeId residual) {
                       return decide_on_arrows(graph_, system_, residual, judge_->decider().budget());
                   });
    }
}

} // namespace lagen
