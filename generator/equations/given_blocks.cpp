// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/given_blocks.hpp"

namespace lagen {

EquationBlock lagrangian_block(Equation lagrangian, const std::string& arguments)
{
    const std::string formula = "L(" + arguments + ")";
    return {"Lagrangian", formula, formula, {std::move(lagrangian)}};
}

EquationBlock lagrangian_block(const SymbolicModel& symbolic, const GiNaC::ex& lagrangian, const std::string& arguments)
{
    return lagrangian_block(symbolic.equation(LeftSide::symbol, symbolic.free_name({"L", "L_E"}), {lagrangian}),
                            arguments);
}

EquationBlock bracket_block(const SymbolicModel& symbolic)
{
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
    return brackets;
}

std::vector<EquationBlock> constraints_and_invariants(SymbolicModel& symbolic)
{
    return constraints_and_invariants(symbolic.model(), symbolic.algebroid(), [&](const Tree& tree) {
        return symbolic.simplified({{"", symbolic.lower(tree)}});
    });
}

std::vector<EquationBlock> constraints_and_invariants(const Model& model, const WrittenAlgebroid& algebroid,
                                                      const std::function<std::vector<TermGroup>(const Tree&)>& write)
{
    EquationBlock constraints{"constraints", "φ(x) = 0 on M", R"(\phi(x) = 0 \text{ on } M)", {}};
    for (const Tree& constraint : algebroid.constraints)
        constraints.equations.push_back({LeftSide::zero, "", {}, write(constraint)});
    EquationBlock invariants{"claimed invariants", "ḟ = 0", R"(\dot f = 0)", {}};
    for (const NamedTree& claim : model.invariants)
        invariants.equations.push_back({LeftSide::symbol, claim.name, {}, write(claim.value)});
    return {constraints, invariants};
}

std::vector<EquationBlock> given_blocks(std::vector<EquationBlock> first, const std::vector<EquationBlock>& behind)
{
    first.insert(first.end(), behind.begin(), behind.end());
    std::erase_if(first, [](const EquationBlock& block) { return block.equations.empty(); });
    return first;
}

} // namespace lagen
