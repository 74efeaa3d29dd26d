// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/section.hpp"

#include "geometry/terms.hpp"
#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

Column column_of(const std::map<std::size_t, NodeId>& sums)
{
    Column column;
    for (const auto& [index, value] : sums) column.push_back({index, value});
    return column;
}

/// terms[c] += X(t^c), or -= where `negative`
void append_derivatives(Terms<std::size_t>& terms, BaseGradient& partial, const VectorField& X, const Column& t,
                        bool negative)
{
    std::vector<NodeId> derivative;
    for (const ColumnEntry& entry : t) {
        derivative.clear();
        partial.append_along(derivative, X, entry.value);
        for (const NodeId term : derivative) terms.add(entry.index, negative ? partial.graph().negate(term) : term);
    }
}

} // namespace

BaseGradient::BaseGradient(Graph& graph, const std::vector<NodeId>& x) : graph_(graph)
{
    for (std::size_t i = 0; i < x.size(); ++i) places_.emplace(x[i], i);
}

const Column& BaseGradient::of(NodeId f)
{
    const auto known = known_.find(f);
    if (known != known_.end()) return known->second;
    Column& column = known_[f];
    std::vector<std::pair<std::size_t, NodeId>> occurring; // by i
    const NodeId roots[] = {f};
    for (const NodeId node : reachable(graph_, roots))
        if (const auto place = places_.find(node); place != places_.end()) occurring.emplace_back(place->second, node);
    if (occurring.empty()) return column;
    std::ranges::sort(occurring);
    std::vector<NodeId> x;
    for (const auto& [i, node] : occurring) x.push_back(node);
    const std::vector<NodeId> partials = gradient(graph_, f, x);
    for (std::size_t k = 0; k < partials.size(); ++k)
        if (!graph_.is_zero(partials[k])) column.push_back({occurring[k].first, partials[k]});
    return column;
}

void BaseGradient::append_along(std::vector<NodeId>& terms, const VectorField& field, NodeId f)
{
    const Column& partials = of(f);
    auto partial = partials.begin();
    for (const ColumnEntry& entry : field) {
        while (partial != partials.end() && partial->index < entry.index) ++partial;
        if (partial == partials.end()) return;
        if (partial->index == entry.index) terms.push_back(graph_.multiply(entry.value, partial->value));
    }
}

NodeId BaseGradient::along(const VectorField& field, NodeId f)
{
    std::vector<NodeId> terms;
    append_along(terms, field, f);
    return graph_.sum(terms);
}

NodeId pairing(Graph& graph, const std::vector<NodeId>& f, const Section& s)
{
    std::vector<NodeId> terms;
    for (const ColumnEntry& entry : s) terms.push_back(graph.multiply(f[entry.index], entry.value));
    return graph.sum(terms);
}

Section basis_section(Graph& graph, std::size_t a)
{
    return {{a, graph.constant(1)}};
}

VectorField anchor_of(Graph& graph, const Algebroid& algebroid, const Section& s)
{
    Terms<std::size_t> terms;
    for (const ColumnEntry& component : s)
        for (const ColumnEntry& rho : algebroid.anchor[component.index])
            terms.add(rho.index, graph.multiply(component.value, rho.value));
    VectorField field = column_of(terms.sums(graph));
    std::erase_if(field, [&](const ColumnEntry& entry) { return graph.is_zero(entry.value); });
    return field;
}

Section bracket(BaseGradient& partial, const Algebroid& algebroid, const Section& s, const Section& t)
{
    Graph& graph = partial.graph();
    Terms<std::size_t> terms;
    append_derivatives(terms, partial, anchor_of(graph, algebroid, s), t, false);
    append_derivatives(terms, partial, anchor_of(graph, algebroid, t), s, true);
    for (const ColumnEntry& a : s)
        for (const ColumnEntry& b : t)
            for (const ColumnEntry& C : algebroid.C(a.index, b.index))
                terms.add(C.index, graph.multiply(graph.multiply(a.value, b.value), C.value));
    return column_of(terms.sums(graph));
}

VectorField bracket(BaseGradient& partial, const VectorField& X, const VectorField& Y)
{
    Terms<std::size_t> terms;
    append_derivatives(terms, partial, X, Y, false);
    append_derivatives(terms, partial, Y, X, true);
    return column_of(terms.sums(partial.graph()));
}

Column sum(Graph& graph, const Column& a, const Column& b)
{
    Terms<std::size_t> terms;
    for (const Column* column : {&a, &b})
        for (const ColumnEntry& entry : *column) terms.add(entry.index, entry.value);
    return column_of(terms.sums(graph));
}

Column difference(Graph& graph, const Column& a, const Column& b)
{
    Terms<std::size_t> terms;
    for (const ColumnEntry& entry : a) terms.add(entry.index, entry.value);
    for (const ColumnEntry& entry : b) terms.add(entry.index, graph.negate(entry.value));
    return column_of(terms.sums(graph));
}

} // namespace lagen
