// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/mechanics.hpp"

#include "graph/differentiate.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace lagen {

namespace {

/// C^c_ab for a < b from whichever order of the pair the algebroid lists; the other order is its negative.
struct PairBracket {
    std::size_t a, b, c;
    NodeId value;
};

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

void add_to(Graph& graph, NodeId& sum, NodeId term)
{
    sum = graph.add(sum, term);
}

/// Entries that are alone in their row and in their column.
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

void declare_inputs(Graph& graph, const Model& model, LagrangeNodes& nodes)
{
    const std::vector<std::string> declared = symbol_names(model);
    const bool free = std::ranges::find(declared, "t") == declared.end();
    nodes.time = graph.input(free ? "t" : "time, which this model cannot name");
    for (const Parameter& parameter : model.parameters) nodes.parameters.push_back(graph.input(parameter.symbol.name));
    for (const Symbol& symbol : model.base.coordinates) nodes.x.push_back(graph.input(symbol.name));
    for (const Symbol& symbol : model.fibre.coordinates) nodes.y.push_back(graph.input(symbol.name));
}

/// W(a, b) for b <= a by a sweep along y^b, mirrored.
std::vector<NodeId> fibre_hessian(Graph& graph, const LagrangeNodes& nodes)
{
    const std::size_t r = nodes.y.size();
    std::vector<NodeId> W(r * r);
    for (std::size_t b = 0; b < r; ++b) {
        const std::pair<NodeId, NodeId> seed[] = {{nodes.y[b], graph.constant(1)}};
        const std::vector<NodeId> column = directional(graph, nodes.momentum, seed);
        for (std::size_t a = b; a < r; ++a) W[a * r + b] = W[b * r + a] = column[a];
    }
    return W;
}

void bind_names(const Model& model, LagrangeNodes& nodes)
{
    nodes.binding["energy"] = nodes.energy;
    nodes.binding["lagrangian"] = nodes.lagrangian;
    for (std::size_t a = 0; a < model.fibre.momenta.size() && a < nodes.momentum.size(); ++a)
        nodes.binding[model.fibre.momenta[a].name] = nodes.momentum[a];
    nodes.binding["t"] = nodes.time;
    for (std::size_t k = 0; k < model.parameters.size(); ++k)
        nodes.binding[model.parameters[k].symbol.name] = nodes.parameters[k];
    for (std::size_t i = 0; i < nodes.x.size(); ++i) nodes.binding[model.base.coordinates[i].name] = nodes.x[i];
    for (std::size_t a = 0; a < nodes.y.size(); ++a) nodes.binding[model.fibre.coordinates[a].name] = nodes.y[a];
}

/// W_ab ydot^b = rho_a(L) - [d/dt p_a along (xdot, 1) at fixed y] - p_c C^c_ab y^b.                     [Martinez 2001]
std::vector<NodeId> accelerations_of(Graph& graph, const LagrangeNodes& nodes, const std::vector<NodeId>& rho,
                                     const std::vector<NodeId>& dL_dx, const std::vector<PairBracket>& brackets,
                                     MatrixStructure structure)
{
    const std::size_t n = nodes.x.size();
    const std::size_t r = nodes.y.size();
    std::vector<std::pair<NodeId, NodeId>> seeds;
    for (std::size_t i = 0; i < n; ++i) seeds.emplace_back(nodes.x[i], nodes.xdot[i]);
    seeds.emplace_back(nodes.time, graph.constant(1));
    const std::vector<NodeId> drift = directional(graph, nodes.momentum, seeds);
    std::vector<NodeId> right(r);
    for (std::size_t a = 0; a < r; ++a) {
        NodeId force = graph.constant(0);
        for (std::size_t i = 0; i < n; ++i) add_to(graph, force, graph.multiply(rho[i * r + a], dL_dx[i]));
        right[a] = graph.subtract(force, drift[a]);
    }
    for (const PairBracket& entry :
         brackets) { // p_c C^c_ab y^b in row a and, by antisymmetry, -p_c C^c_ab y^a in row b
        const NodeId moment = graph.multiply(entry.value, nodes.momentum[entry.c]);
        right[entry.a] = graph.subtract(right[entry.a], graph.multiply(moment, nodes.y[entry.b]));
        right[entry.b] = graph.add(right[entry.b], graph.multiply(moment, nodes.y[entry.a]));
    }
    return graph.solve(nodes.W, right, structure);
}

} // namespace

LagrangeNodes lagrange_nodes(Graph& graph, const Model& model, const VerifiedAlgebroid& verified, bool accelerations)
{
    LagrangeNodes nodes;
    declare_inputs(graph, model, nodes);
    const std::size_t n = nodes.x.size();
    const std::size_t r = nodes.y.size();
    Lowering lower(graph);
    nodes.lagrangian = lower(model.lagrangian);
    std::vector<NodeId> rho(n * r, graph.constant(0));
    for (const AnchorValue& entry : verified.algebroid.rho)
        add_to(graph, rho[entry.i * r + entry.a], lower(entry.value));
    const std::vector<PairBracket> brackets = bracket_of_pairs(graph, lower, verified.algebroid);

    std::vector<NodeId> variables = nodes.y;
    variables.insert(variables.end(), nodes.x.begin(), nodes.x.end());
    const std::vector<NodeId> dL = gradient(graph, nodes.lagrangian, variables);
    nodes.momentum.assign(dL.begin(), dL.begin() + static_cast<std::ptrdiff_t>(r));
    const std::vector<NodeId> dL_dx(dL.begin() + static_cast<std::ptrdiff_t>(r), dL.end());

    NodeId work = graph.constant(0);
    for (std::size_t a = 0; a < r; ++a) add_to(graph, work, graph.multiply(nodes.y[a], nodes.momentum[a]));
    nodes.energy = graph.subtract(work, nodes.lagrangian);
    nodes.xdot.assign(n, graph.constant(0));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t a = 0; a < r; ++a) add_to(graph, nodes.xdot[i], graph.multiply(rho[i * r + a], nodes.y[a]));
    nodes.W = fibre_hessian(graph, nodes);
    if (accelerations) {
        // What holds for the file's parameter values alone says nothing of a header whose parameters may be changed.
        const Regularity& regularity = verified.regularity;
        const auto structure = regularity.positive_definite && !regularity.for_given_parameters
                                   ? MatrixStructure::positive_definite
                                   : MatrixStructure::symmetric;
        nodes.ydot = accelerations_of(graph, nodes, rho, dL_dx, brackets, structure);
        nodes.pivots = single_blocks(graph, nodes.W, r);
    }
    bind_names(model, nodes);
    return nodes;
}

} // namespace lagen
