// SPDX-License-Identifier: GPL-2.0-or-later
/// Trials of changed entries, and the changes that are worth a trial.
#include "advice/repair.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// Does the file give the pair in this order, in the other alone, or not at all? The first two are the same to a
/// change of both orders at once.
bool both_given(const Algebroid& algebroid, std::size_t a, std::size_t b)
{
    return algebroid.given[a * algebroid.r() + b] && algebroid.given[b * algebroid.r() + a];
}

void append_places(std::vector<EntryPlace>& places, const Algebroid& algebroid, std::size_t a, std::size_t b)
{
    for (const ColumnEntry& entry : algebroid.C(a, b)) places.push_back({false, a, b, entry.index});
}

/// R^i and v^i at the same i, the i with the simplest v^i first.
std::vector<std::pair<NodeId, NodeId>> quotients(Graph& graph, const Column& residual, const Column& divisor)
{
    std::vector<std::pair<NodeId, NodeId>> pairs;
    for (const ColumnEntry& entry : residual) {
        const NodeId below = Algebroid::entry(graph, divisor, entry.index);
        if (!graph.is_zero(below) && !graph.is_zero(entry.value)) pairs.emplace_back(entry.value, below);
    }
    std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& p, const auto& q) {
        return graph.is_constant(p.second) && !graph.is_constant(q.second);
    });
    return pairs;
}

} // namespace

NodeId value_at(Graph& graph, const Algebroid& algebroid, const EntryPlace& place)
{
    const Column& column = place.anchor ? algebroid.anchor[place.a] : algebroid.C(place.a, place.b);
    return Algebroid::entry(graph, column, place.index);
}

Trial::Trial(Graph& graph, Algebroid& algebroid, const Repair& repair) : graph_(graph)
{
    const std::size_t r = algebroid.r();
    for (const auto& [place, value] : repair.changes) {
        if (place.anchor) {
            set(algebroid.anchor[place.a], place.index, value);
            continue;
        }
        set(algebroid.bracket[place.a * r + place.b], place.index, value);
        if (!both_given(algebroid, place.a, place.b))
            set(algebroid.bracket[place.b * r + place.a], place.index, graph.negate(value));
    }
}

Trial::~Trial()
{
    for (auto entry = before_.rbegin(); entry != before_.rend(); ++entry) *entry->first = std::move(entry->second);
}

void Trial::set(Column& column, std::size_t index, NodeId value)
{
    before_.emplace_back(&column, column);
    std::erase_if(column, [&](const ColumnEntry& entry) { return entry.index == index; });
    if (graph_.is_zero(value)) return;
    const auto after =
        std::find_if(column.begin(), column.end(), [&](const ColumnEntry& entry) { return entry.index > index; });
    column.insert(after, {index, value});
}

std::vector<EntryPlace> editable_places(const Algebroid& algebroid, const Editable& editable, bool missing)
{
    std::vector<EntryPlace> places;
    const std::size_t r = algebroid.r();
    if (editable.bracket)
        for (std::size_t a = 0; a < r; ++a)
            for (std::size_t b = a + 1; b < r; ++b) {
                append_places(places, algebroid, a, b);
                if (both_given(algebroid, a, b)) append_places(places, algebroid, b, a);
            }
    if (editable.anchor)
        for (std::size_t a = 0; a < r; ++a)
            for (const ColumnEntry& entry : algebroid.anchor[a]) places.push_back({true, a, 0, entry.index});
    if (!missing || !editable.bracket) return places;
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = a + 1; b < r; ++b)
            for (std::size_t c = 0; c < r; ++c) {
                const EntryPlace place{false, a, b, c};
                if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
            }
    return places;
}

std::vector<Repair> sign_repairs(Graph& graph, const Algebroid& algebroid, const Editable& editable)
{
    std::vector<Repair> repairs;
    for (const EntryPlace& place : editable_places(algebroid, editable, false))
        repairs.push_back({RepairKind::sign, {{place, graph.negate(value_at(graph, algebroid, place))}}});
    if (!editable.bracket) return repairs;
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = a + 1; b < algebroid.r(); ++b) {
            if (algebroid.C(a, b).size() < 2 || both_given(algebroid, a, b)) continue;
            Repair repair{RepairKind::order, {}};
            for (const ColumnEntry& entry : algebroid.C(a, b))
                repair.changes.push_back({{false, a, b, entry.index}, graph.negate(entry.value)});
            repairs.push_back(std::move(repair));
        }
    return repairs;
}

std::vector<Repair> needed_brackets(Graph& graph, const Algebroid& algebroid, std::size_t a, std::size_t b,
                                    const Column& anchor_residual)
{
    std::vector<Repair> repairs;
    for (std::size_t c = 0; c < algebroid.r(); ++c) {
        const auto pairs = quotients(graph, anchor_residual, algebroid.anchor[c]);
        if (pairs.empty()) continue;
        const EntryPlace place{false, a, b, c};
        const NodeId more = graph.divide(pairs[0].first, pairs[0].second);
        repairs.push_back({RepairKind::needed, {{place, graph.add(value_at(graph, algebroid, place), more)}}});
    }
    return repairs;
}

std::vector<Repair> needed_anchors(Graph& graph, const Algebroid& algebroid, std::size_t a, std::size_t b,
                                   const Column& anchor_residual)
{
    std::vector<Repair> repairs;
    for (const ColumnEntry& bracket : algebroid.C(a, b))
        for (const ColumnEntry& residual : anchor_residual) {
            if (graph.is_zero(residual.value)) continue;
            const EntryPlace place{true, bracket.index, 0, residual.index};
            const NodeId more = graph.divide(residual.value, bracket.value);
            repairs.push_back({RepairKind::value, {{place, graph.add(value_at(graph, algebroid, place), more)}}});
        }
    return repairs;
}

std::vector<Repair> annihilating_anchors(Graph& graph, BaseGradient& partial, const Algebroid& algebroid, std::size_t a,
                                         NodeId f, NodeId derivative)
{
    std::vector<Repair> repairs;
    for (const ColumnEntry& slope : Column(partial.of(f))) {
        const EntryPlace place{true, a, 0, slope.index};
        const NodeId less = graph.divide(derivative, slope.value);
        repairs.push_back({RepairKind::value, {{place, graph.subtract(value_at(graph, algebroid, place), less)}}});
    }
    return repairs;
}

} // namespace lagen
