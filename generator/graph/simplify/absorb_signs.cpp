// SPDX-License-Identifier: GPL-2.0-or-later
/// Last touches of a form: names with one use go back into it, and signs move to where they cost nothing.
#include "graph/simplify/form.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace lagen {
namespace {

/// The distinct monomials with their places, as the graph will share them.
std::map<Monomial, std::vector<Place>> monomials_of(const Form& form)
{
    std::map<Monomial, std::vector<Place>> uses;
    for (const Place& place : live_places(form))
        for (const Term& term : at(form, place)) uses[term.monomial].push_back(place);
    return uses;
}

/// -a - b ... with no positive term to subtract from: one operation for the sign.
bool costs_sign(const Polynomial& polynomial)
{
    return !polynomial.empty() &&
           std::ranges::all_of(polynomial, [](const Term& term) { return sgn(term.coefficient) < 0; });
}

bool is_odd_in(const Monomial& monomial, AtomId atom)
{
    const auto found = std::ranges::lower_bound(monomial, atom, {}, &Factor::atom);
    return found != monomial.end() && found->atom == atom && found->exponent % 2 != 0;
}

/// Negates the terms of `place` that are odd in `atom`.
void flip_users(Polynomial& polynomial, AtomId atom)
{
    for (Term& term : polynomial)
        if (is_odd_in(term.monomial, atom)) term.coefficient = -term.coefficient;
}

/// Signs that must be computed, then terms that are subtracted.
struct SignCost {
    int signs = 0;
    int minuses = 0;

    void count(const Polynomial& polynomial, int times)
    {
        signs += costs_sign(polynomial) ? times : 0;
        for (const Term& term : polynomial) minuses += sgn(term.coefficient) < 0 ? times : 0;
    }
};

/// What flipping the sign of `atom` costs (negative: saves).
SignCost flip_cost(const Form& form, AtomId atom, const std::vector<Place>& users)
{
    SignCost cost;
    for (const Place& place : users) {
        Polynomial flipped = at(form, place);
        cost.count(flipped, -1);
        flip_users(flipped, atom);
        cost.count(flipped, 1);
    }
    Polynomial own = form.algebra[atom].operands[0];
    cost.count(own, -1);
    for (Term& term : own) term.coefficient = -term.coefficient;
    cost.count(own, 1);
    return cost;
}

using Users = std::map<AtomId, std::vector<Place>>;

/// The polynomials in which each named sum stands. (Products pass signs on, they cannot absorb one.)
Users users_of_sums(const Form& form)
{
    Users users;
    for (const Place& place : live_places(form)) {
        std::set<AtomId> here;
        for (const Term& term : at(form, place))
            for (const Factor& factor : term.monomial)
                if (form.algebra[factor.atom].op == Op::add && here.insert(factor.atom).second)
                    users[factor.atom].push_back(place);
    }
    return users;
}

void flip(Form& form, AtomId atom, const std::vector<Place>& users)
{
    for (const Place& place : users) flip_users(at(form, place), atom);
    for (Term& term : form.algebra.operands(atom)[0]) term.coefficient = -term.coefficient;
}

/// Flips the first sum inside `atom` that gains by it; false where none does.
bool flip_inner_sum(Form& form, AtomId atom, const Users& users)
{
    const Polynomial own = form.algebra[atom].operands[0];
    for (const Term& term : own)
        for (const Factor& factor : term.monomial) {
            const auto inner = users.find(factor.atom);
            if (inner == users.end() || flip_cost(form, inner->first, inner->second).signs >= 0) continue;
            flip(form, inner->first, inner->second);
            return true;
        }
    return false;
}

} // namespace

void inline_single_products(Form& form)
{
    bool changed = true;
    while (changed) {
        changed = false;
        std::map<AtomId, std::set<Monomial>> users;
        const auto uses = monomials_of(form);
        for (const auto& [monomial, places] : uses)
            for (const Factor& factor : monomial)
                if (form.algebra[factor.atom].op == Op::multiply) users[factor.atom].insert(monomial);
        std::set<Monomial> touched; // a monomial changes once a round
        for (const auto& [atom, holders] : users) {
            const Monomial& holder = *holders.begin();
            const Term own = form.algebra[atom].operands[0].at(0);
            const auto factor = std::ranges::lower_bound(holder, atom, {}, &Factor::atom);
            if (holders.size() > 1 || factor->exponent != 1 || own.monomial == holder) continue;
            if (!touched.insert(holder).second || touched.contains(own.monomial)) continue;
            Term rest{1, holder};
            std::erase_if(rest.monomial, [name = atom](const Factor& f) { return f.atom == name; });
            const Term next = form.algebra.multiply(rest, own);
            for (const Place& place : uses.at(holder))
                for (Term& term : at(form, place))
                    if (term.monomial == holder) term = {term.coefficient * next.coefficient, next.monomial};
            changed = true;
        }
    }
    for (const Place& place : live_places(form))
        std::ranges::sort(at(form, place), [](const Term& a, const Term& b) { return a.monomial < b.monomial; });
}

void absorb_signs(Form& form)
{
    Users users = users_of_sums(form);
    for (const auto& [atom, places] : users) {
        const SignCost cost = flip_cost(form, atom, places);
        if (cost.signs > 0) continue;
        flip(form, atom, places);
        // An even exchange pays where a sum inside takes the new sign: -(a + (b - c) d) = (c - b) d - a, and where
        // fewer terms are subtracted: a - m (b - c) = a + m (c - b), so that rows of cyclic equations look alike.
        if (cost.signs == 0 && !flip_inner_sum(form, atom, users) && cost.minuses >= 0) flip(form, atom, places);
    }
}

} // namespace lagen
