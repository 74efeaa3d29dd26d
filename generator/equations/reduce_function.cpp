// SPDX-License-Identifier: GPL-2.0-or-later
/// L or H with definitions for the coefficients that are equal to them.
#include "equations/kept_symbols.hpp"
#include "symbolic/shortest_form.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// The terms of a sum, the factors of a product; anything else is one part.
template <class Composite>
GiNaC::exvector parts_of(const GiNaC::ex& e)
{
    if (!GiNaC::is_a<Composite>(e)) return {e};
    return {e.begin(), e.end()};
}

} // namespace

/// For definitions on points D = c k + rest with a parameter k that is nowhere in the rest: k and (D - rest)/c.
std::vector<std::pair<GiNaC::ex, GiNaC::ex>> KeptSymbols::pivots()
{
    std::vector<std::pair<GiNaC::ex, GiNaC::ex>> result;
    for (std::size_t k = 0; k < kept_.size(); ++k) {
        if (!kept_[k].tree || !kept_[k].of_points || !expanded_length(value_of(k))) continue;
        const GiNaC::ex body = value_of(k).expand();
        for (const Parameter& parameter : model_.parameters) {
            const GiNaC::ex symbol = symbols_.symbol(parameter.symbol.name);
            const GiNaC::ex slope = body.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
            if (!GiNaC::is_a<GiNaC::numeric>(slope) || slope.is_zero()) continue;
            result.emplace_back(symbol, (kept_[k].symbol - body + slope * symbol).expand() / slope);
            break;
        }
    }
    return result;
}

/// With definitions that are not of points written out.
GiNaC::ex KeptSymbols::without_moving(GiNaC::ex f)
{
    for (bool more = true; more;) {
        more = false;
        for (const std::size_t k : symbols_in(f))
            if (!kept_[k].of_points) {
                f = f.subs(kept_[k].symbol == value_of(k), GiNaC::subs_options::no_pattern);
                more = true;
            }
    }
    return f;
}

std::size_t KeptSymbols::cost_of(const GiNaC::ex& f) const
{
    return to_text(shortest_form(f, symbols_, order_)).size();
}

/// With those parameters replaced that make the expanded sum shorter.
GiNaC::ex KeptSymbols::shortened(GiNaC::ex sum, const std::vector<std::pair<GiNaC::ex, GiNaC::ex>>& rules) const
{
    sum = sum.expand();
    std::size_t cost = cost_of(sum);
    for (bool more = true; more;) {
        more = false;
        const GiNaC::ex before = sum;
        for (const auto& [parameter, replacement] : rules) {
            if (!before.has(parameter)) continue;
            const GiNaC::ex next = before.subs(parameter == replacement, GiNaC::subs_options::no_pattern).expand();
            const std::size_t next_cost = cost_of(next);
            if (next_cost >= cost) continue;
            sum = next;
            cost = next_cost;
            more = true;
        }
    }
    return sum;
}

/// Without names of parts, T of L = T - V: they would hide all that T is made of.
GiNaC::ex KeptSymbols::without_parts(GiNaC::ex f)
{
    for (bool more = true; more;) {
        more = false;
        for (const std::size_t k : symbols_in(f)) {
            const GiNaC::ex slope = f.diff(GiNaC::ex_to<GiNaC::symbol>(kept_[k].symbol));
            if (kept_[k].of_points || !GiNaC::is_a<GiNaC::numeric>(slope)) continue;
            f = f.subs(kept_[k].symbol == value_of(k), GiNaC::subs_options::no_pattern);
            more = true;
        }
    }
    return f;
}

GiNaC::ex KeptSymbols::reduced(const GiNaC::ex& whole, const GiNaC::exvector& moving)
{
    if (kept_.empty()) return whole;
    const GiNaC::ex f = without_parts(whole);
    const GiNaC::ex open = without_moving(f);
    if (!expanded_length(open)) return f;
    const auto rules = pivots();
    std::map<GiNaC::ex, GiNaC::exvector, GiNaC::ex_is_less> coefficients;
    for (const GiNaC::ex& term : parts_of<GiNaC::add>(open.expand())) {
        GiNaC::ex monomial = 1, coefficient = 1;
        for (const GiNaC::ex& factor : parts_of<GiNaC::mul>(term)) {
            const bool moves = std::ranges::any_of(moving, [&](const GiNaC::ex& each) { return factor.has(each); });
            (moves || !symbols_in(factor).empty() ? monomial : coefficient) *= factor;
        }
        coefficients[monomial].push_back(coefficient);
    }
    GiNaC::exvector terms;
    for (const auto& [monomial, sum] : coefficients)
        terms.push_back(monomial * shortened(GiNaC::ex(GiNaC::dynallocate<GiNaC::add>(sum)), rules));
    const GiNaC::ex sum(GiNaC::dynallocate<GiNaC::add>(terms));
    const GiNaC::ex result = to_ginac(shortest_form(sum, symbols_, order_), symbols_);
    return cost_with_definitions(result) < cost_with_definitions(f) ? result : f;
}

/// Characters of an expression and of what its symbols stand for.
std::size_t KeptSymbols::cost_with_definitions(const GiNaC::ex& f)
{
    std::size_t sum = cost_of(f);
    std::set<std::size_t> used;
    std::vector<std::size_t> pending = symbols_in(f);
    while (!pending.empty()) {
        const std::size_t k = pending.back();
        pending.pop_back();
        if (!used.insert(k).second) continue;
        sum += cost_of(value_of(k));
        for (const std::size_t inner : symbols_in(value_of(k))) pending.push_back(inner);
    }
    return sum;
}

} // namespace lagen
