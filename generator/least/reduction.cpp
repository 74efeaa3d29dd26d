// SPDX-License-Identifier: GPL-2.0-or-later
#include "least/reduction.hpp"

#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {

namespace {

constexpr LeastRule rule_table[] = {{"constant", hold_constants},        {"kept", keep_invariant_set},
                                    {"watched", leave_out_unwatched},    {"differences", lump_lanes},
                                    {"own_equation", find_own_equation}, {"momentum", solve_by_conserved}};

} // namespace

std::span<const LeastRule> least_rules()
{
    return rule_table;
}

Reduction::Reduction(LaneSystem given)
    : system(std::move(given)), prover(*system.graph, system.setting, system.values), written(system.rates)
{
}

NodeId Reduction::rate_of(NodeId function) const
{
    Replacements seeds = replacements(system.lanes, system.rates);
    seeds.emplace_back(system.time, graph().constant(1));
    return directional(graph(), std::vector{function}, seeds)[0];
}

std::optional<NodeId> Reduction::at_start(NodeId function) const
{
    Replacements start{{system.time, system.start_time.value_or(graph().constant(0))}};
    for (std::size_t i = 0; i < system.lanes.size(); ++i)
        if (system.start[i]) start.emplace_back(system.lanes[i], *system.start[i]);
    for (const StartConstant& constant : constants)
        if (constant.value) start.emplace_back(constant.input, *constant.value);
    const auto there = substitute_where_defined(graph(), std::vector{function}, start);
    if (!there) return std::nullopt;
    const auto is_open = [&](NodeId input) { return depends_on_any(graph(), *there, std::vector{input}); };
    if (std::ranges::any_of(system.lanes, is_open)) return std::nullopt;
    for (const StartConstant& constant : constants)
        if (is_open(constant.input)) return std::nullopt;
    return (*there)[0];
}

void Reduction::erase(const std::vector<NodeId>& lanes)
{
    for (const NodeId lane : lanes) {
        const auto i = std::ranges::find(system.lanes, lane) - system.lanes.begin();
        if (i == std::ssize(system.lanes)) continue;
        for (auto* each : {&system.lanes, &system.rates, &written}) each->erase(each->begin() + i);
        system.start.erase(system.start.begin() + i);
        for (std::vector<NodeId>& jump : system.jumps) jump.erase(jump.begin() + i);
    }
}

bool Reduction::replace(const Replacements& values, bool holds)
{
    Reduction next = *this;
    if (!holds) // what else depends on these lanes is not followed
        std::erase_if(next.system.candidates, [&](const NamedNode& candidate) {
            const bool is_lost = std::ranges::any_of(values, [&](const auto& value) {
                return depends_on_any(graph(), std::vector{candidate.node}, std::vector{value.first});
            });
            if (is_lost) next.not_followed.push_back(candidate.name);
            return is_lost;
        });
    std::vector<NodeId*> places;
    for (auto* nodes : {&next.system.rates, &next.system.walls, &next.written})
        for (NodeId& node : *nodes) places.push_back(&node);
    for (auto* named : {&next.system.watched, &next.system.candidates})
        for (NamedNode& each : *named) places.push_back(&each.node);
    for (std::vector<NodeId>& jump : next.system.jumps)
        for (NodeId& behind : jump) places.push_back(&behind);
    for (auto& [lane, value] : next.definitions) places.push_back(&value);
    std::vector<NodeId> nodes;
    for (const NodeId* place : places) nodes.push_back(*place);
    const auto moved = substitute_where_defined(graph(), nodes, values);
    if (!moved || (holds && !next.prover.restrict_to(values, {}))) return false;
    for (std::size_t k = 0; k < places.size(); ++k) *places[k] = (*moved)[k];
    std::vector<NodeId> lanes;
    for (const auto& [lane, value] : values) lanes.push_back(lane);
    next.erase(lanes);
    std::erase_if(next.system.walls, [&](NodeId wall) { return graph().is_constant(wall); });
    *this = std::move(next);
    return true;
}

bool Reduction::define(NodeId lane, NodeId value)
{
    Reduction next = *this;
    if (!next.replace({{lane, value}}, true)) return false;
    const auto i = std::ranges::find(system.lanes, lane) - system.lanes.begin();
    next.written = written;
    next.written.erase(next.written.begin() + i);
    next.definitions = definitions;
    next.definitions.emplace_back(lane, value);
    *this = std::move(next);
    return true;
}

void Reduction::hold(const std::vector<NodeId>& lanes)
{
    for (const NodeId lane : lanes) constants.push_back({lane, at_start(lane), name_of(lane)});
    erase(lanes);
    (void)prover.restrict_to({}, lanes);
}

std::vector<NodeId> Reduction::wanted() const
{
    std::vector<NodeId> functions;
    for (const NamedNode& each : system.watched) functions.push_back(each.node);
    for (const NodeId wall : system.walls) {
        const auto sides = graph().operands(wall);
        functions.push_back(graph().subtract(sides[0], sides[1]));
    }
    return functions;
}

bool Reduction::survives_jumps(NodeId function)
{
    for (const std::vector<NodeId>& jump : system.jumps) {
        const std::vector<NodeId> behind = substitute(graph(), std::vector{function}, replacements(system.lanes, jump));
        const auto needed = prover.vanishing({graph().subtract(behind[0], function)});
        if (!needed || !needed->empty()) return false;
    }
    return true;
}

} // namespace lagen
