// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/decide.hpp"

#include <algorithm>

namespace lagen {

ProofBudget smaller(ProofBudget budget, const ProofBudget& other)
{
    budget.terms = std::min(budget.terms, other.terms);
    budget.products = std::min(budget.products, other.products);
    budget.points = std::min(budget.points, other.points);
    budget.tries = std::min(budget.tries, other.tries);
    budget.searches = std::min(budget.searches, other.searches);
    budget.precision = std::min(budget.precision, other.precision);
    return budget;
}

} // namespace lagen
