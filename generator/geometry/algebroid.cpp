// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/algebroid.hpp"

#include <algorithm>

namespace lagen {

std::vector<NodeId> Algebroid::entries() const
{
    std::vector<NodeId> values;
    for (const std::vector<Column>* columns : {&anchor, &bracket})
        for (const Column& column : *columns)
            for (const ColumnEntry& entry : column) values.push_back(entry.value);
    return values;
}

NodeId Algebroid::entry(Graph& graph, const Column& column, std::size_t index)
{
    for (const ColumnEntry& entry : column)
        if (entry.index == index) return entry.value;
    return graph.constant(0);
}

AlgebroidBuilder::AlgebroidBuilder(Graph& graph, std::vector<NodeId> x, std::size_t r) : graph_(graph)
{
    result_.x = std::move(x);
    result_.anchor.resize(r);
    result_.bracket.resize(r * r);
    result_.given.assign(r * r, false);
}

void AlgebroidBuilder::add_anchor(std::size_t i, std::size_t a, NodeId value)
{
    if (!graph_.is_zero(value)) result_.anchor[a].push_back({i, value});
}

void AlgebroidBuilder::add_bracket(std::size_t c, std::size_t a, std::size_t b, NodeId value)
{
    const std::size_t pair = a * result_.r() + b;
    result_.given[pair] = true;
    if (!graph_.is_zero(value)) result_.bracket[pair].push_back({c, value});
}

Algebroid AlgebroidBuilder::finish(std::vector<NodeId> y)
{
    const std::size_t r = result_.r();
    result_.y = std::move(y);
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b)
            if (result_.given[a * r + b] && !result_.given[b * r + a])
                for (const ColumnEntry& entry : result_.bracket[a * r + b])
                    result_.bracket[b * r + a].push_back({entry.index, graph_.negate(entry.value)});
    for (std::vector<Column>* columns : {&result_.anchor, &result_.bracket})
        for (Column& column : *columns) std::ranges::stable_sort(column, {}, &ColumnEntry::index);
    return std::move(result_);
}

} // namespace lagen
