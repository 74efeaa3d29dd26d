// SPDX-License-Identifier: GPL-2.0-or-later
/// Lowering of rho and C, and the anchor derivative rho_a(f) = rho^i_a df/dx^i.
#include "geometry/lowered_algebroid.hpp"
#include "graph/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

void sort_column(Column& column)
{
    std::sort(column.begin(), column.end(),
              [](const ColumnEntry& a, const ColumnEntry& b) { return a.index < b.index; });
}

} // namespace

std::vector<NodeId> LoweredAlgebroid::entries() const
{
    std::vector<NodeId> values;
    for (const std::vector<Column>* columns : {&anchor, &bracket})
        for (const Column& column : *columns)
            for (const ColumnEntry& entry : column) values.push_back(entry.value);
    return values;
}

NodeId LoweredAlgebroid::entry(Graph& graph, const Column& column, std::size_t index)
{
    for (const ColumnEntry& entry : column)
        if (entry.index == index) return entry.value;
    return graph.constant(0);
}

LoweredAlgebroid lower_algebroid(Graph& graph, Lowering& lower, const Algebroid& algebroid)
{
    LoweredAlgebroid result;
    for (const Symbol& symbol : algebroid.base) result.x.push_back(graph.input(symbol.name));
    for (const Symbol& symbol : algebroid.fibre) result.y.push_back(graph.input(symbol.name));
    const std::size_t r = algebroid.r();
    result.anchor.resize(r);
    result.bracket.resize(r * r);
    result.given.assign(r * r, false);
    for (const AnchorValue& entry : algebroid.rho) {
        const NodeId value = lower(entry.value);
        if (!graph.is_zero(value)) result.anchor[entry.a].push_back({entry.i, value});
    }
    for (const StructureValue& entry : algebroid.C) {
        const NodeId value = lower(entry.value);
        result.given[entry.a * r + entry.b] = true;
        if (!graph.is_zero(value)) result.bracket[entry.a * r + entry.b].push_back({entry.c, value});
    }
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b)
            if (result.given[a * r + b] && !result.given[b * r + a])
                for (const ColumnEntry& entry : result.bracket[a * r + b])
                    result.bracket[b * r + a].push_back({entry.index, graph.negate(entry.value)});
    for (Column& column : result.anchor) sort_column(column);
    for (Column& column : result.bracket) sort_column(column);
    return result;
}

const Column& BaseGradient::of(NodeId f)
{
    const auto known = known_.find(f);
    if (known != known_.end()) return known->second;
    Column& column = known_[f];
    if (graph_.is_constant(f) || x_.empty()) return column;
    const std::vector<NodeId> partials = gradient(graph_, f, x_);
    for (std::size_t i = 0; i < partials.size(); ++i)
        if (!graph_.is_zero(partials[i])) column.push_back({i, partials[i]});
    return column;
}

void BaseGradient::append_anchor_derivative(std::vector<NodeId>& terms, const Column& anchor, NodeId f, bool negative)
{
    const Column& partials = of(f);
    auto partial = partials.begin();
    for (const ColumnEntry& rho : anchor) {
        while (partial != partials.end() && partial->index < rho.index) ++partial;
        if (partial == partials.end()) return;
        if (partial->index == rho.index) {
            const NodeId term = graph_.multiply(rho.value, partial->value);
            terms.push_back(negative ? graph_.negate(term) : term);
        }
    }
}

} // namespace lagen
