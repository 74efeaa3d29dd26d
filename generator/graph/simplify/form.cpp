// SPDX-License-Identifier: GPL-2.0-or-later
/// Walks over a form.
#include "graph/simplify/form.hpp"

namespace lagen {
namespace {

void append_atoms(const Polynomial& polynomial, std::vector<AtomId>& atoms)
{
    for (const Term& term : polynomial)
        for (const Factor& factor : term.monomial) atoms.push_back(factor.atom);
}

} // namespace

std::vector<AtomId> live_atoms(const Form& form)
{
    enum class Mark : std::uint8_t { unseen, open, done };
    struct Visit {
        AtomId atom;
        std::vector<AtomId> below;
        std::size_t next;
    };
    std::vector<Mark> marks(form.algebra.size(), Mark::unseen);
    std::vector<AtomId> order;
    std::vector<AtomId> starts;
    for (const Polynomial& root : form.roots) append_atoms(root, starts);
    std::vector<Visit> stack;
    const auto enter = [&](AtomId id) {
        if (marks[id] == Mark::done) return;
        if (marks[id] == Mark::open) throw FormRefused{};
        marks[id] = Mark::open;
        Visit visit{id, {}, 0};
        for (const Polynomial& operand : form.algebra[id].operands) append_atoms(operand, visit.below);
        stack.push_back(std::move(visit));
    };
    for (const AtomId start : starts) {
        enter(start);
        while (!stack.empty()) {
            Visit& visit = stack.back();
            if (visit.next < visit.below.size()) {
                enter(visit.below[visit.next++]);
                continue;
            }
            marks[visit.atom] = Mark::done;
            order.push_back(visit.atom);
            stack.pop_back();
        }
    }
    return order;
}

std::vector<Place> live_places(const Form& form)
{
    std::vector<Place> places;
    for (const AtomId atom : live_atoms(form))
        for (std::size_t k = 0; k < form.algebra[atom].operands.size(); ++k) places.push_back({false, atom, k});
    for (std::size_t k = 0; k < form.roots.size(); ++k) places.push_back({true, 0, k});
    return places;
}

Polynomial& at(Form& form, const Place& place)
{
    return place.root ? form.roots[place.operand] : form.algebra.operands(place.atom)[place.operand];
}

const Polynomial& at(const Form& form, const Place& place)
{
    return place.root ? form.roots[place.operand] : form.algebra[place.atom].operands[place.operand];
}

} // namespace lagen
