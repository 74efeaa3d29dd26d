// SPDX-License-Identifier: GPL-2.0-or-later
/// The recursion over cases.
#include "proof/prove_by_cases.hpp"

#include <algorithm>

namespace lagen::proof {
namespace {

constexpr int deepest_case = 4;              ///< distinctions, one within another
constexpr std::size_t most_sign_terms = 120; ///< of a numerator that is looked at as a sum of signs

bool is_zero(const Signs& signs)
{
    return !signs.negative && !signs.positive;
}

bool contains(const Polynomial& p, GeneratorId id)
{
    return std::any_of(p.begin(), p.end(), [id](const Term& term) { return term.monomial.exponent_of(id) > 0; });
}

/// Every coefficient of a power product of variables, a polynomial in constants such as sqrt(2), has the sign 0 alone;
/// or the whole has.
bool vanishes_by_signs(Ring& ring, const Polynomial& p)
{
    std::map<std::string, Polynomial> coefficients;
    for (const Term& term : p) {
        Monomial variables, constants;
        for (std::size_t k = 0; k < term.monomial.size(); ++k) {
            const GeneratorId id = term.monomial.generator(k);
            Monomial& part = ring.generator(id).value ? constants : variables;
            part = part * Monomial(id, term.monomial.exponent(k));
        }
        coefficients[key_of(variables)].push_back({constants, term.coefficient});
    }
    const auto vanishes = [&ring](const Polynomial& q) {
        return q.size() <= most_sign_terms && is_zero(ring.signs(q));
    };
    if (coefficients.size() <= most_sign_terms &&
        std::all_of(coefficients.begin(), coefficients.end(),
                    [&](const auto& entry) { return vanishes(collect(entry.second, ring.work())); }))
        return true;
    return vanishes(p);
}

class Cases {
  public:
    Cases(const Graph& graph, const ProofSetting& setting, const std::vector<SolvedConstraint>& constraints,
          const std::vector<NonnegativeOperand>& operands, NodeId node, Work budget)
        : graph_(graph), setting_(setting), constraints_(constraints), operands_(operands), node_(node), budget_(budget)
    {
        // A division in a branch that is not taken says nothing of the case.
        const std::vector<NodeId> needed = reachable(graph, std::vector<NodeId>{node});
        branches_ = std::any_of(needed.begin(), needed.end(), [&](NodeId id) { return graph.op(id) == Op::select; });
    }

    [[nodiscard]] bool prove(const Assumptions& assumptions, int depth)
    {
        std::vector<OpenSign> open;
        try {
            NormalForm forms(graph_, setting_, constraints_, node_, operands_, budget_, Angles::split, assumptions);
            const Fraction form = forms.of(node_);
            if (forms.ring().is_contradictory()) return true;
            if (!forms.condition().empty()) return false;
            if (form.is_zero() || forms.elementary().is_vanishing_angle(form)) return true;
            if (forms.elementary().is_vanishing_logarithm(form)) return true;
            if (vanishes_by_signs(forms.ring(), form.num)) return true;
            budget_.products = forms.ring().work().products;
            open = forms.elementary().open_signs();
            std::stable_sort(open.begin(), open.end(), [&](const OpenSign& a, const OpenSign& b) {
                const auto stands = [&](const OpenSign& sign) {
                    return !sign.absolute || contains(form.num, *sign.absolute);
                };
                return stands(a) && !stands(b);
            });
        } catch (const VanishingDivisor&) {
            return !assumptions.empty() && !branches_;
        } catch (const BudgetExhausted&) {
            return false;
        }
        if (depth == deepest_case) return false;
        for (const OpenSign& sign : open) {
            const auto is_known = [&](const Assumption& assumption) {
                return same_tree(assumption.polynomial, sign.polynomial);
            };
            if (std::any_of(assumptions.begin(), assumptions.end(), is_known)) continue;
            const bool apart = std::any_of(open.begin(), open.end(), [&](const OpenSign& other) {
                return other.zero_apart && same_tree(other.polynomial, sign.polynomial);
            });
            return prove_each(assumptions, sign.polynomial, apart, depth);
        }
        return false;
    }

  private:
    [[nodiscard]] bool prove_each(const Assumptions& assumptions, const Tree& polynomial, bool apart, int depth)
    {
        std::vector<Signs> cases{{false, !apart, true}, {true, !apart, false}};
        if (apart) cases.push_back({false, true, false});
        return std::all_of(cases.begin(), cases.end(), [&](const Signs& signs) {
            Assumptions more = assumptions;
            more.push_back({polynomial, signs});
            return prove(more, depth + 1);
        });
    }

    const Graph& graph_;
    const ProofSetting& setting_;
    const std::vector<SolvedConstraint>& constraints_;
    const std::vector<NonnegativeOperand>& operands_;
    NodeId node_;
    Work budget_;
    bool branches_ = false;
};

} // namespace

bool proves_by_cases(const Graph& graph, const ProofSetting& setting, const std::vector<SolvedConstraint>& constraints,
                     const std::vector<NonnegativeOperand>& operands, NodeId node, Work budget)
{
    return Cases(graph, setting, constraints, operands, node, budget).prove({}, 0);
}

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
