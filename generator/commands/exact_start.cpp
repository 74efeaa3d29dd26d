// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/exact_start.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/lagrange.hpp"
#include "verify/verify.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {
namespace {

Tree value_in(const std::vector<NamedTree>& given, const std::string& name)
{
    const auto found = std::ranges::find(given, name, &NamedTree::name);
    return found == given.end() ? nullptr : found->value;
}

bool is_closed(const Graph& graph, NodeId node)
{
    const NodeId roots[] = {node};
    return std::ranges::none_of(reachable(graph, roots), [&](NodeId each) { return graph.op(each) == Op::input; });
}

/// The node where it has no inputs and is this number; else the double.
NodeId node_or_double(Graph& graph, NodeId node, long double value)
{
    if (is_closed(graph, node)) {
        const NodeId roots[] = {node};
        const long double there = evaluate<long double>(graph, roots, {})[0];
        if (std::abs(there - value) <= 1e-15L * std::abs(value)) return node;
    }
    return graph.constant(Rational(static_cast<double>(value)));
}

NodeId lowered(Graph& graph, const Tree& tree, const Replacements& parameters)
{
    const NodeId node[] = {Lowering(graph)(tree)};
    return substitute(graph, node, parameters)[0];
}

} // namespace

void put_exact_parameters(CheckedModel& checked, const Scene& scene, const std::vector<long double>& values)
{
    System& system = checked.system;
    if (!set_parameters(system, values)) return;
    for (std::size_t k = 0; k < values.size(); ++k) {
        auto& [parameter, value] = system.parameter_values[k];
        if (const Tree given = value_in(scene.parameters, system.graph.input_name(parameter)))
            value = node_or_double(system.graph, Lowering(system.graph)(given), values[k]);
    }
    if (rests_on_values(checked.report.mechanics.regularity))
        checked.report.mechanics.regularity = verify_regularity(system);
}

std::vector<NodeId> exact_start(Graph& graph, const System& system, const Scene& scene,
                                const std::vector<long double>& state)
{
    const auto given = [&](NodeId input, NodeId absent) {
        const Tree tree = value_in(scene.initial, graph.input_name(input));
        return tree == nullptr ? absent : lowered(graph, tree, system.parameter_values);
    };
    std::vector<NodeId> start;
    Replacements at = system.parameter_values;
    for (std::size_t i = 0; i < system.n(); ++i) {
        const NodeId x = system.algebroid.x[i];
        start.push_back(node_or_double(graph, given(x, x), state[i]));
        at.emplace_back(x, start.back());
    }
    std::vector<NodeId> momenta = system.mu; // those of the velocities that the scene gives
    if (system.lagrangian) {
        const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
        const NodeId rest = graph.constant(0);
        for (const NodeId y : lagrangian.fibre.y) at.emplace_back(y, given(y, scene.rest ? rest : y));
        momenta = substitute(graph, lagrangian.fibre.momenta, at);
    }
    for (std::size_t a = 0; a < system.r(); ++a)
        start.push_back(node_or_double(graph, given(system.mu[a], momenta[a]), state[system.n() + a]));
    return start;
}

} // namespace lagen
