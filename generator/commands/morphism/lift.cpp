// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/morphism/lift.hpp"

#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/momentum_balance.hpp"
#include "model/plain_names.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

/// lifted_x, under names that the target does not have.
std::vector<std::string> names_of_lifts(const SystemMorphism& map)
{
    std::vector<std::string> names;
    for (const NodeId x : map.source.algebroid.x) names.push_back("lifted_" + map.source.graph.input_name(x));
    names = plain_names(names);
    for (std::string& name : names)
        while (map.target.declares(name)) name += "_";
    return names;
}

} // namespace

LiftedTarget lifted_target(const Model& target, const SystemMorphism& map, const std::vector<NamedNumber>& parameters)
{
    LiftedTarget lifted{target, names_of_lifts(map)};
    Graph graph = map.source.graph;
    Replacements values;
    for (const auto& [name, value] : parameters)
        values.emplace_back(graph.input(name), graph.constant(Rational(static_cast<double>(value))));
    for (std::size_t i = 0; i < lifted.names.size(); ++i)
        values.emplace_back(map.source.algebroid.x[i], graph.input(lifted.names[i]));
    std::vector<NodeId> y; // stand-ins: names of the target may be others in the source
    for (const NodeId each : map.target.algebroid.y) {
        const std::string name = map.target.graph.input_name(each);
        y.push_back(graph.input(name + "'"));
        values.emplace_back(y.back(), graph.input(name));
    }
    const std::vector<NodeId> Phi = fibre_matrix(graph, map);
    const Places all = first_places(y.size());
    const std::vector<NodeId> velocity = CramersRule{graph, Phi, y.size(), all, all, y}.solution();
    const std::vector<NodeId> rates = substitute(graph, base_velocity(graph, map.source.algebroid, velocity), values);
    for (std::size_t i = 0; i < rates.size(); ++i) {
        FirstOrderState state;
        state.symbol.name = lifted.names[i];
        state.rate = to_tree(graph, rates[i]);
        lifted.model.states.push_back(std::move(state));
    }
    return lifted;
}

} // namespace lagen
