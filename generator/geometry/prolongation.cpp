// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/prolongation.hpp"

#include "geometry/terms.hpp"

namespace lagen {

Algebroid prolongation(Graph& graph, const Algebroid& algebroid, const std::vector<NodeId>& z)
{
    const std::size_t n = algebroid.n(), r = algebroid.r();
    std::vector<NodeId> x = algebroid.x, fibre;
    x.insert(x.end(), z.begin(), z.end());
    for (const char* kind : {"X ", "V "})
        for (const NodeId each : z) fibre.push_back(graph.input(kind + graph.input_name(each)));
    AlgebroidBuilder builder(graph, std::move(x), 2 * r);
    for (std::size_t a = 0; a < r; ++a) {
        for (const ColumnEntry& entry : algebroid.anchor[a]) builder.add_anchor(entry.index, a, entry.value);
        builder.add_anchor(n + a, r + a, graph.constant(1));
        for (std::size_t b = 0; b < r; ++b)
            for (const ColumnEntry& entry : algebroid.C(a, b)) builder.add_bracket(entry.index, a, b, entry.value);
    }
    return builder.finish(std::move(fibre));
}

Section vertical_lift(const Algebroid& algebroid, const Section& s)
{
    Section lift = s;
    for (ColumnEntry& entry : lift) entry.index += algebroid.r();
    return lift;
}

Section complete_lift(BaseGradient& partial, const Algebroid& algebroid, const Section& s)
{
    Graph& graph = partial.graph();
    Terms<std::size_t> terms;
    for (std::size_t b = 0; b < algebroid.r(); ++b) {
        const NodeId y = algebroid.y[b];
        for (const auto& [a, value] : s) {
            if (const NodeId slope = partial.along(algebroid.anchor[b], value); !graph.is_zero(slope))
                terms.add(a, graph.multiply(y, slope));
            for (const ColumnEntry& entry : algebroid.C(b, a))
                terms.add(entry.index, graph.multiply(graph.multiply(entry.value, y), value));
        }
    }
    Section lift = s;
    for (const auto& [a, value] : terms.sums(graph))
        if (!graph.is_zero(value)) lift.push_back({algebroid.r() + a, value});
    return lift;
}

} // namespace lagen
