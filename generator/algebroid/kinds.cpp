// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebroid/kinds.hpp"

namespace lagen {
namespace {

std::vector<NodeId> inputs(Graph& graph, const std::vector<std::string>& names)
{
    std::vector<NodeId> nodes;
    for (const std::string& name : names) nodes.push_back(graph.input(name));
    return nodes;
}

} // namespace

Algebroid tangent(Graph& graph, const std::vector<std::string>& x, const std::vector<std::string>& y)
{
    AlgebroidBuilder builder(graph, inputs(graph, x), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) builder.add_anchor(i, i, graph.constant(1));
    return builder.finish(inputs(graph, y));
}

Algebroid lie_algebra(Graph& graph, const std::vector<std::string>& y, const std::vector<StructureConstant>& constants)
{
    AlgebroidBuilder builder(graph, {}, y.size());
    for (const StructureConstant& C : constants) builder.add_bracket(C.c, C.a, C.b, graph.constant(C.value));
    return builder.finish(inputs(graph, y));
}

} // namespace lagen
