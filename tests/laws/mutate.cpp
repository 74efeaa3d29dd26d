// SPDX-License-Identifier: GPL-2.0-or-later
/// Signs, sizes from 1e-12 to 1e-15, orders, missing entries, forgotten constraints, special parameters, branches.
#include "mutate.hpp"

#include "disguise.hpp"

namespace lagen::laws {
namespace {

/// A place in rho or C.
struct Place {
    bool in_anchor = false;
    std::size_t c = 0, a = 0, b = 0; ///< rho(c, a) or C(c, a, b)
};

std::vector<Place> places(const LocalAlgebroid& E, bool nonzero)
{
    std::vector<Place> list;
    for (std::size_t a = 0; a < E.r(); ++a) {
        for (std::size_t i = 0; i < E.n(); ++i)
            if (!nonzero || !E.anchor(i, a).is_zero()) list.push_back({true, i, a, 0});
        for (std::size_t b = a + 1; b < E.r(); ++b)
            for (std::size_t c = 0; c < E.r(); ++c)
                if (!nonzero || !E.bracket(c, a, b).is_zero()) list.push_back({false, c, a, b});
    }
    return list;
}

Formula entry_at(const LocalAlgebroid& E, const Place& place)
{
    return place.in_anchor ? E.anchor(place.c, place.a) : E.bracket(place.c, place.a, place.b);
}

void set_entry(LocalAlgebroid& E, const Place& place, const Formula& value)
{
    if (place.in_anchor)
        E.anchor(place.c, place.a) = value;
    else
        E.set_bracket(place.c, place.a, place.b, value);
}

using Change = std::function<Formula(const LocalAlgebroid&, const Formula&, Dice&)>;

/// One entry (one that is not zero, or any) becomes change(entry).
Mutation on_entry(const std::string& name, bool nonzero, Change change)
{
    return {name, [nonzero, change](LocalAlgebroid& E, Dice& dice) {
                const std::vector<Place> list = places(E, nonzero);
                if (list.empty()) return false;
                const Place place = dice.pick(list);
                set_entry(E, place, change(E, entry_at(E, place), dice));
                return true;
            }};
}

/// 10^-12 .. 10^-15
mpq_class tiny(Dice& dice)
{
    mpz_class scale("1000000000000");
    for (std::size_t k = dice.below(4); k > 0; --k) scale *= 10;
    return mpq_class(dice.signed_digit(9) < 0 ? -1 : 1, scale);
}

Formula any_coordinate(const LocalAlgebroid& E, Dice& dice)
{
    return E.n() == 0 ? Formula(1) : E.coordinate(dice.below(E.n()));
}

Formula special_parameter(LocalAlgebroid& E)
{
    const std::string name = E.parameters.empty() ? "k" : E.parameters.front();
    if (E.parameters.empty()) E.parameters.push_back(name);
    return Formula::variable(name);
}

bool for_special_parameters(LocalAlgebroid& E, Dice& dice)
{
    const std::vector<Place> list = places(E, false);
    if (list.empty()) return false;
    const Place place = dice.pick(list);
    // The file's default value is 1, where the change vanishes.
    const Formula k = special_parameter(E), old = entry_at(E, place);
    const Formula gone = k * (k - Formula(1)) * (dice.flip() ? Formula(1) : k + Formula(2));
    set_entry(E, place, dice.flip() ? old + gone * any_coordinate(E, dice) : old * (Formula(1) + gone));
    return true;
}

/// Holds on x^2 + y^2 = 1 (or x = y) alone, which the model does not declare.
bool on_undeclared_surface(LocalAlgebroid& E, Dice& dice)
{
    const std::vector<Place> list = places(E, false);
    if (list.empty() || E.n() == 0) return false;
    const Place place = dice.pick(list);
    Formula h(-1);
    for (std::size_t i = 0; i < E.n(); ++i) h = h + power(E.coordinate(i), 2);
    if (!E.constraints.empty()) h = h - Formula(1);
    set_entry(E, place, entry_at(E, place) + h * Formula(dice.signed_digit(3)));
    return true;
}

bool without_constraints(LocalAlgebroid& E, Dice&)
{
    const bool some = !E.constraints.empty();
    E.constraints.clear();
    E.solved.clear();
    return some;
}

bool without_domain(LocalAlgebroid& E, Dice&)
{
    const bool some = !E.positive.empty();
    E.positive.clear();
    return some;
}

bool wrong_branch(LocalAlgebroid& E, Dice& dice)
{
    const std::vector<Place> list = places(E, false);
    if (list.empty() || E.n() == 0) return false;
    const Place place = dice.pick(list);
    const Formula change = dice.pick(half_zeros(any_coordinate(E, dice), any_coordinate(E, dice)));
    set_entry(E, place, entry_at(E, place) + change);
    return true;
}

bool swapped_pair(LocalAlgebroid& E, Dice& dice)
{
    if (E.r() < 2) return false;
    const std::size_t a = dice.below(E.r()), b = (a + 1 + dice.below(E.r() - 1)) % E.r();
    for (std::size_t c = 0; c < E.r(); ++c) E.set_bracket(c, a, b, -E.bracket(c, a, b));
    return true;
}

bool swapped_columns(LocalAlgebroid& E, Dice& dice)
{
    if (E.r() < 2 || E.n() == 0) return false;
    const std::size_t a = dice.below(E.r()), b = (a + 1 + dice.below(E.r() - 1)) % E.r();
    for (std::size_t i = 0; i < E.n(); ++i) std::swap(E.anchor(i, a), E.anchor(i, b));
    return true;
}

bool inconsistent_orders(LocalAlgebroid& E, Dice& dice)
{
    if (E.r() < 2) return false;
    const std::size_t a = dice.below(E.r() - 1), b = a + 1 + dice.below(E.r() - 1 - a);
    SecondOrder second{a, b, {}};
    for (std::size_t c = 0; c < E.r(); ++c) second.entries.push_back(-E.bracket(c, a, b));
    Formula& entry = second.entries[dice.below(E.r())];
    entry = dice.flip() ? entry + Formula(tiny(dice)) : entry * Formula(-1) + any_coordinate(E, dice);
    E.second_orders.push_back(second);
    return true;
}

} // namespace

const std::vector<Mutation>& mutations()
{
    static const std::vector<Mutation> list{
        on_entry("sign", true, [](const auto&, const Formula& f, Dice&) { return -f; }),
        on_entry("relative 1e-12..-15", true,
                 [](const auto&, const Formula& f, Dice& d) { return f * Formula(mpq_class(1 + tiny(d))); }),
        on_entry("absolute 1e-12..-15", false,
                 [](const auto&, const Formula& f, Dice& d) { return f + Formula(tiny(d)); }),
        on_entry("factor 1 + x 1e-14", true,
                 [](const LocalAlgebroid& E, const Formula& f, Dice& d) {
                     return f * (Formula(1) + Formula(tiny(d)) * any_coordinate(E, d));
                 }),
        on_entry("missing entry", true, [](const auto&, const Formula&, Dice&) { return Formula(); }),
        on_entry("extra term", false,
                 [](const LocalAlgebroid& E, const Formula& f, Dice& d) {
                     return f + Formula(d.signed_digit(2)) * any_coordinate(E, d);
                 }),
        {"swapped pair", swapped_pair},
        {"swapped columns", swapped_columns},
        {"inconsistent orders", inconsistent_orders},
        {"special parameters", for_special_parameters},
        {"undeclared surface", on_undeclared_surface},
        {"constraint left out", without_constraints},
        {"domain left out", without_domain},
        {"one branch only", wrong_branch},
    };
    return list;
}

} // namespace lagen::laws
