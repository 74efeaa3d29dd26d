// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/domain_signs.hpp"

#include <algorithm>

namespace lagen::proof {

namespace {

constexpr std::size_t most_signed_terms = 3000; ///< ten times what Ring::signs looks at: what is longer has no sign

} // namespace

Signs domain_signs(const Graph& graph, const ProofSetting& setting, const std::vector<SolvedConstraint>& constraints,
                   const std::vector<NonnegativeOperand>& operands, NodeId value, Work budget)
{
    budget.terms = std::min(budget.terms, most_signed_terms);
    const std::vector<SolvedConstraint> none;
    std::vector<const std::vector<SolvedConstraint>*> sets{&constraints};
    // A constraint that is put in may hide a sign, as that of 2 + z^2 with z^2 = 1 - x^2 - y^2.
    if (!constraints.empty()) sets.push_back(&none);
    Signs known;
    for (const auto* each : sets)
        for (const Angles angles : {Angles::split, Angles::whole}) {
            try {
                NormalForm forms(graph, setting, *each, value, operands, budget, angles);
                const Fraction form = forms.of(value);
                if (forms.condition().empty()) known = both(known, forms.ring().signs(form));
            } catch (const BudgetExhausted&) { // nothing learnt
            } catch (const VanishingDivisor&) {
                return {};
            }
            if (static_cast<int>(known.negative) + known.zero + known.positive <= 1) return known;
        }
    return known;
}

} // namespace lagen::proof
