// SPDX-License-Identifier: GPL-2.0-or-later
/// Assumed signs: the cases of |p|, min, max, sign and if. A case adds a fact to the ring; p = 0 also eliminates a
/// variable where p is linear in one.
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

#include <algorithm>

namespace lagen::proof {

std::optional<Signs> Elementary::assumed(const Polynomial& p, const Tree& tree)
{
    if (!tree) return std::nullopt;
    const auto at = std::ranges::find_if(
        assumptions_, [&](const Assumption& assumption) { return same_tree(assumption.polynomial, tree); });
    if (at == assumptions_.end()) return std::nullopt;
    const Signs known = both(at->signs, ring_.signs(p));
    if (applied_.insert(static_cast<std::size_t>(at - assumptions_.begin())).second) {
        ring_.add_fact(p, known);
        ring_.propagate_facts();
        if (!known.negative && !known.positive) eliminate(p);
        refined_ = true; // what was made before did not know it
    }
    return known;
}

/// p = 0 as the relation v = rest of a free variable v with coefficient 1 or -1.
void Elementary::eliminate(const Polynomial& p)
{
    for (std::size_t k = 0; k < p.size(); ++k) {
        if (p[k].monomial.size() != 1 || p[k].monomial.exponent(0) != 1 || abs(p[k].coefficient) != 1) continue;
        const GeneratorId variable = p[k].monomial.generator(0);
        const Generator& generator = ring_.generator(variable);
        bool usable = generator.power == 0 && generator.partner < 0 && !generator.value;
        Polynomial rest;
        for (std::size_t j = 0; j < p.size() && usable; ++j) {
            if (j == k) continue;
            for (std::size_t i = 0; i < p[j].monomial.size(); ++i) {
                const Generator& other = ring_.generator(p[j].monomial.generator(i));
                usable = usable && p[j].monomial.generator(i) != variable && other.power == 0 && other.partner < 0;
            }
            rest.push_back(p[j]);
        }
        if (!usable) continue;
        ring_.set_relation(variable, 1, scale(rest, -p[k].coefficient));
        return;
    }
}

Signs Elementary::sign_of(const Fraction& a)
{
    Polynomial product = a.num;
    // The sign of n / d is that of n d.
    for (const auto& [index, power] : a.factors)
        if (power % 2 != 0) product = ring_.times(product, Polynomial(ring_.factor(index)));
    if (product.empty()) return {false, true, false};
    if (product[0].coefficient < 0) {
        Fraction negative = ring_.negate(a);
        return -sign_of(negative);
    }
    const mpz_class common = content(product); // first: arguments are evaluated in any order
    product = divide_content(std::move(product), common);
    const Signs known = ring_.signs(product);
    if (static_cast<int>(known.negative) + known.zero + known.positive <= 1) return known;
    const Tree tree = print(ring_, product, longest_open).tree;
    if (const auto assumption = assumed(product, tree)) return *assumption;
    if (tree) open_signs_.push_back({tree, true, std::nullopt});
    return known;
}

} // namespace lagen::proof
