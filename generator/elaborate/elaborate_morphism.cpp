// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/elaborate_morphism.hpp"

#include "elaborate/elaborate.hpp"
#include "graph/calculus/differentiate.hpp"
#include "proof/triangular.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

std::vector<NodeId> lowered(Lowering& lower, const std::vector<Tree>& trees)
{
    std::vector<NodeId> nodes;
    for (const Tree& tree : trees) nodes.push_back(lower(tree));
    return nodes;
}

/// What the source calls so among `known`; else a symbol of its own, under a name that is free there.
NodeId namesake(SystemMorphism& morphism, NodeId symbol, const std::vector<NodeId>& known)
{
    System& source = morphism.source;
    const std::string name = morphism.target.graph.input_name(symbol);
    NodeId value = source.graph.input(name);
    if (std::ranges::find(known, value) != known.end() ||
        source.graph.op(value) != Op::input) // a parameter of the source that is bound
        return value;
    if (source.declares(name)) value = source.graph.input(name + "'");
    morphism.free_parameters.push_back(value);
    return value;
}

void match_parameters(SystemMorphism& morphism, Lowering& lower, const std::vector<Tree>& values)
{
    const std::vector<NodeId>& known = morphism.source.parameters;
    for (std::size_t k = 0; k < morphism.target.parameters.size(); ++k) {
        const NodeId parameter = morphism.target.parameters[k];
        morphism.parameters[parameter] = values[k] ? lower(values[k]) : namesake(morphism, parameter, known);
    }
    for (const NodeId input : morphism.target.inputs)
        morphism.parameters[input] = namesake(morphism, input, morphism.source.inputs);
}

/// Phi^a_b(x) y^b in place of what is linear in y and does not look it. Throws ModelError for what is not linear, or
/// not shown to be.
void require_linear(SystemMorphism& morphism, const MorphismFile& file)
{
    Graph& graph = morphism.source.graph;
    const std::vector<NodeId>& y = morphism.source.algebroid.y;
    const std::vector<NodeId> zeros(y.size(), graph.constant(0));
    ProofSetting setting;
    setting.variables = morphism.source.algebroid.x;
    setting.variables.insert(setting.variables.end(), y.begin(), y.end());
    setting.parameters = morphism.source.parameters;
    setting.constraints = morphism.source.functions.constraints;
    setting.domain = morphism.source.domain;
    (void)proof::keep_triangular(graph, setting);
    for (std::size_t a = 0; a < morphism.fibre.size(); ++a) {
        NodeId& value = morphism.fibre[a];
        const auto row = substitute_where_defined(graph, gradient(graph, value, y), replacements(y, zeros));
        NodeId linear = graph.constant(0);
        for (std::size_t b = 0; row && b < y.size(); ++b) linear = graph.add(linear, graph.multiply((*row)[b], y[b]));
        const NodeId rest = graph.subtract(value, linear);
        const bool shown =
            row && (graph.is_zero(rest) || ZeroDecider(graph, setting).status(rest) == ProofStatus::proved);
        if (!shown)
            throw ModelError(fmt::format("the value of '{}' is not linear in the fibre coordinates of {}",
                                         ambient_fibre(file.target)[a].name, file.source.name),
                             file.fibre[a]->where, "a morphism of algebroids is linear on each fibre");
        value = linear;
    }
}

} // namespace

SystemMorphism elaborate(const MorphismFile& file)
{
    SystemMorphism morphism;
    morphism.source = elaborate(file.source);
    morphism.target = elaborate(file.target);
    Lowering lower(morphism.source.graph);
    match_parameters(morphism, lower, file.parameters);
    morphism.base = lowered(lower, file.base);
    morphism.fibre = lowered(lower, file.fibre);
    morphism.controls = lowered(lower, file.controls);
    morphism.element = lowered(lower, file.element);
    require_linear(morphism, file);
    const bool both = morphism.source.groupoid && morphism.target.groupoid;
    morphism.of_groupoids = both && (!file.element.empty() || !file.target.groupoid->has_group());
    return morphism;
}

SystemMorphism elaborate_whole(const MorphismFile& file)
{
    if (file.stages.empty()) return elaborate(file);
    SystemMorphism whole = elaborate(file.stages.front());
    for (std::size_t k = 1; k < file.stages.size(); ++k) whole = composition(whole, elaborate(file.stages[k]));
    return whole;
}

} // namespace lagen
