// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/system.hpp"

#include "graph/differentiate.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace lagen {

namespace {

/// C^c_ab for a < b from whichever order of the pair the algebroid lists; the other order is its negative.
std::vector<PairBracket> bracket_of_pairs(Graph& graph, Lowering& lower, const Algebroid& algebroid)
{
    using Pair = std::pair<std::size_t, std::size_t>;
    std::map<Pair, bool> ascending; // a pair that is listed in ascending order is read in that order
    for (const StructureValue& entry : algebroid.C)
        if (entry.a != entry.b) ascending[std::minmax(entry.a, entry.b)] |= entry.a < entry.b;
    std::vector<PairBracket> brackets;
    for (const StructureValue& entry : algebroid.C) {
        if (entry.a == entry.b || ascending[std::minmax(entry.a, entry.b)] != (entry.a < entry.b)) continue;
        const NodeId value = lower(entry.value);
        if (entry.a < entry.b)
            brackets.push_back({entry.a, entry.b, entry.c, value});
        else
            brackets.push_back({entry.b, entry.a, entry.c, graph.negate(value)});
    }
    return brackets;
}

} // namespace

SystemNodes system_nodes(Graph& graph, const Model& model, const Algebroid& algebroid)
{
    SystemNodes system;
    const std::vector<std::string> declared = symbol_names(model);
    const bool free = std::ranges::find(declared, "t") == declared.end();
    system.time = graph.input(free ? "t" : "time, which this model cannot name");
    for (const Parameter& parameter : model.parameters) system.parameters.push_back(graph.input(parameter.symbol.name));
    for (const Symbol& symbol : model.base.coordinates) system.x.push_back(graph.input(symbol.name));
    system.r = model.fibre.coordinates.size();
    Lowering lower(graph);
    system.rho.assign(system.x.size() * system.r, graph.constant(0));
    for (const AnchorValue& entry : algebroid.rho) {
        NodeId& rho = system.rho[entry.i * system.r + entry.a];
        rho = graph.add(rho, lower(entry.value));
    }
    system.brackets = bracket_of_pairs(graph, lower, algebroid);
    return system;
}

std::vector<NodeId> base_velocity(Graph& graph, const SystemNodes& system, const std::vector<NodeId>& y)
{
    std::vector<NodeId> xdot(system.x.size(), graph.constant(0));
    for (std::size_t i = 0; i < xdot.size(); ++i)
        for (std::size_t a = 0; a < system.r; ++a)
            xdot[i] = graph.add(xdot[i], graph.multiply(system.rho[i * system.r + a], y[a]));
    return xdot;
}

std::vector<NodeId> along_anchor(Graph& graph, const SystemNodes& system, const std::vector<NodeId>& df_dx)
{
    std::vector<NodeId> result(system.r, graph.constant(0));
    for (std::size_t a = 0; a < system.r; ++a)
        for (std::size_t i = 0; i < system.x.size(); ++i)
            result[a] = graph.add(result[a], graph.multiply(system.rho[i * system.r + a], df_dx[i]));
    return result;
}

void subtract_brackets(Graph& graph, const SystemNodes& system, const std::vector<NodeId>& p,
                       const std::vector<NodeId>& y, std::vector<NodeId>& right)
{
    // p_c C^c_ab y^b in row a and, by antisymmetry, -p_c C^c_ab y^a in row b
    for (const PairBracket& entry : system.brackets) {
        const NodeId moment = graph.multiply(entry.value, p[entry.c]);
        right[entry.a] = graph.subtract(right[entry.a], graph.multiply(moment, y[entry.b]));
        right[entry.b] = graph.add(right[entry.b], graph.multiply(moment, y[entry.a]));
    }
}

Slopes slopes_of(Graph& graph, NodeId f, const std::vector<NodeId>& lanes, const SystemNodes& system)
{
    std::vector<NodeId> variables = lanes;
    variables.insert(variables.end(), system.x.begin(), system.x.end());
    variables.push_back(system.time);
    const std::vector<NodeId> df = gradient(graph, f, variables);
    const auto first_x = df.begin() + static_cast<std::ptrdiff_t>(lanes.size());
    return {{df.begin(), first_x}, {first_x, df.end() - 1}, df.back()};
}

std::vector<std::pair<NodeId, NodeId>> replacements(const std::vector<NodeId>& inputs, const std::vector<NodeId>& nodes)
{
    std::vector<std::pair<NodeId, NodeId>> result;
    for (std::size_t k = 0; k < inputs.size(); ++k) result.emplace_back(inputs[k], nodes[k]);
    return result;
}

Binding system_names(const Model& model, const SystemNodes& system)
{
    Binding binding;
    binding["t"] = system.time;
    for (std::size_t k = 0; k < system.parameters.size(); ++k)
        binding[model.parameters[k].symbol.name] = system.parameters[k];
    for (std::size_t i = 0; i < system.x.size(); ++i) binding[model.base.coordinates[i].name] = system.x[i];
    return binding;
}

std::vector<NodeId> single_blocks(const Graph& graph, const std::vector<NodeId>& W, std::size_t r)
{
    std::vector<NodeId> pivots;
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b) {
            if (graph.is_zero(W[a * r + b])) continue;
            std::size_t others = 0;
            for (std::size_t k = 0; k < r; ++k) {
                if (k != b && !graph.is_zero(W[a * r + k])) ++others;
                if (k != a && !graph.is_zero(W[k * r + b])) ++others;
            }
            const NodeId pivot = W[a * r + b];
            if (others == 0 && !graph.is_constant(pivot) && std::ranges::find(pivots, pivot) == pivots.end())
                pivots.push_back(pivot);
        }
    return pivots;
}

NodeId contraction(Graph& graph, const std::vector<NodeId>& a, const std::vector<NodeId>& b)
{
    NodeId sum = graph.constant(0);
    for (std::size_t k = 0; k < a.size(); ++k) sum = graph.add(sum, graph.multiply(a[k], b[k]));
    return sum;
}

} // namespace lagen
