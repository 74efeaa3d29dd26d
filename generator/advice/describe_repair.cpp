// SPDX-License-Identifier: GPL-2.0-or-later
#include "advice/describe_repair.hpp"

#include "graph/core/lower.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t longest_value = 200; ///< characters; a longer one helps nobody

/// Does the file have the pair (b, a) alone? Then the hint speaks of that order.
bool is_reversed(const Algebroid& lowered, const EntryPlace& place)
{
    const std::size_t r = lowered.r();
    return !place.anchor && lowered.given[place.b * r + place.a] && !lowered.given[place.a * r + place.b];
}

std::string owner(const WrittenAlgebroid& names, const Algebroid& lowered, const EntryPlace& place)
{
    if (place.anchor) return "the anchor of " + names.fibre[place.a].name;
    const bool reversed = is_reversed(lowered, place);
    return "[" + names.fibre[reversed ? place.b : place.a].name + ", " +
           names.fibre[reversed ? place.a : place.b].name + "]";
}

std::string component(const WrittenAlgebroid& names, const EntryPlace& place)
{
    return "component " + (place.anchor ? names.base : names.fibre)[place.index].name;
}

/// The normal form, in the order of the file.
std::string value_text(Graph& graph, Judge& judge, const Algebroid& lowered, const EntryPlace& place, NodeId value)
{
    const NodeId shown = is_reversed(lowered, place) ? graph.negate(value) : value;
    return graph.is_zero(shown) ? "0" : judge.decide(shown).residual;
}

/// As the file has it.
std::string given_text(const WrittenAlgebroid& names, const Algebroid& lowered, const EntryPlace& place)
{
    const bool reversed = is_reversed(lowered, place);
    const std::size_t a = reversed ? place.b : place.a, b = reversed ? place.a : place.b;
    if (place.anchor) {
        for (const AnchorValue& entry : names.rho)
            if (entry.a == a && entry.i == place.index) return to_text(entry.value);
    } else {
        for (const StructureValue& entry : names.C)
            if (entry.a == a && entry.b == b && entry.c == place.index) return to_text(entry.value);
    }
    return "none";
}

} // namespace

Repair simplified(Graph& graph, Judge& judge, Repair repair)
{
    for (EntryChange& change : repair.changes) {
        if (graph.is_constant(change.value)) continue;
        const Decision& decision = judge.decide(change.value);
        if (decision.status == ProofStatus::proved)
            change.value = graph.constant(0);
        else if (const NodeId value = decision.normal_form ? Lowering(graph)(decision.normal_form) : change.value;
                 graph.is_constant(value))
            change.value = value;
    }
    return repair;
}

bool is_admissible(const Graph& graph, const Algebroid& algebroid, const Editable& editable, const Repair& repair)
{
    if (!editable.constant_bracket) return true;
    return std::all_of(repair.changes.begin(), repair.changes.end(), [&](const EntryChange& change) {
        if (change.place.anchor) return true;
        const NodeId roots[] = {change.value};
        const std::vector<NodeId> nodes = reachable(graph, roots);
        return std::none_of(algebroid.x.begin(), algebroid.x.end(),
                            [&](NodeId x) { return std::binary_search(nodes.begin(), nodes.end(), x); });
    });
}

std::string describe(Graph& graph, Judge& judge, const WrittenAlgebroid& names, const Algebroid& lowered,
                     const std::vector<Repair>& repairs, const std::string& what)
{
    std::vector<std::string> phrases;
    for (const Repair& repair : repairs) {
        const auto& [place, value] = repair.changes.front();
        const std::string whose = owner(names, lowered, place), which = component(names, place);
        const std::string wanted = value_text(graph, judge, lowered, place, value);
        const std::string given = given_text(names, lowered, place);
        std::string phrase;
        if (repair.kind == RepairKind::sign) {
            phrase = "the opposite sign of " + which + " of " + whose;
        } else if (repair.kind == RepairKind::order) {
            phrase = "the opposite sign of " + whose + ", as if its sections were given in the wrong order";
        } else if (wanted.size() > longest_value || given.size() > longest_value) {
            continue;
        } else if (repair.kind == RepairKind::needed && repairs.size() == 1) {
            return whose + " needs " + which + " = " + wanted + ", given is " + given + "; with it " + what + " hold";
        } else if (graph.is_zero(value)) {
            phrase = whose + " without its " + which;
        } else {
            phrase = which + " = " + wanted + " of " + whose + " (given is " + given + ")";
        }
        // On a constraint one value has many forms, and the same normal form.
        if (std::find(phrases.begin(), phrases.end(), phrase) == phrases.end()) phrases.push_back(phrase);
    }
    std::string text;
    for (const std::string& phrase : phrases) text += (text.empty() ? what + " hold with " : ", or with ") + phrase;
    return text;
}

} // namespace lagen
