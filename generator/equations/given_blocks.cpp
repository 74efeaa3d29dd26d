// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/given_blocks.hpp"

namespace lagen {

std::vector<EquationBlock> lagrangian_and_brackets(SymbolicModel& symbolic, const GiNaC::ex& lagrangian)
{
    const EquationBlock function{"Lagrangian",
                                 "L(x, y)",
                                 "L(x, y)",
                                 {symbolic.equation(LeftSide::symbol, symbolic.free_name({"L", "L_E"}), {lagrangian})}};
    EquationBlock brackets{"brackets", "[e_a, e_b] = C^c_ab e_c", R"([e_a, e_b] = C^c_{ab}\, e_c)", {}};
    const std::vector<Symbol>& fibre = symbolic.algebroid().fibre;
    for (std::size_t a = 0; a < symbolic.r(); ++a)
        for (std::size_t b = a + 1; b < symbolic.r(); ++b) {
            Equation bracket{LeftSide::commutator, fibre[a].name, {}, {}};
            bracket.other = fibre[b].name;
            for (std::size_t c = 0; c < symbolic.r(); ++c)
                for (TermGroup& group : symbolic.simplified({{"", symbolic.C(c, a, b)}})) {
                    group.basis = {fibre[c].name};
                    bracket.groups.push_back(std::move(group));
                }
            if (!bracket.groups.empty()) brackets.equations.push_back(std::move(bracket));
        }
    if (brackets.equations.empty()) return {function};
    return {function, brackets};
}

std::vector<EquationBlock> constraints_and_invariants(SymbolicModel& symbolic)
{
    EquationBlock constraints{"constraints", "φ(x) = 0 on M", R"(\phi(x) = 0 \text{ on } M)", {}};
    for (const Tree& constraint : symbolic.algebroid().constraints)
        constraints.equations.push_back(symbolic.equation(LeftSide::zero, "", {symbolic.lower(constraint)}));
    EquationBlock invariants{"claimed invariants", "ḟ = 0", R"(\dot f = 0)", {}};
    for (const NamedTree& claim : symbolic.model().invariants)
        invariants.equations.push_back(symbolic.equation(LeftSide::symbol, claim.name, {symbolic.lower(claim.value)}));
    std::vector<EquationBlock> blocks{constraints, invariants};
    std::erase_if(blocks, [](const EquationBlock& block) { return block.equations.empty(); });
    return blocks;
}

} // namespace lagen
