// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/quotient.hpp"

#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {

namespace {

Replacements fixed(const System& whole, const Slice& slice)
{
    Replacements out;
    for (std::size_t j = 0; j < slice.frozen.size(); ++j)
        out.emplace_back(whole.algebroid.x[slice.frozen[j]], slice.values[j]);
    return out;
}

/// The entries k in K of fields, the row k the equation of x^k: shape (|K|, |K|).
std::vector<NodeId> frozen_block(const std::vector<std::vector<NodeId>>& fields, const Slice& slice)
{
    std::vector<NodeId> block;
    for (const std::size_t k : slice.frozen)
        for (const std::vector<NodeId>& field : fields) block.push_back(field[k]);
    return block;
}

} // namespace

Replacements Quotient::on_slice(const System& whole) const
{
    return fixed(whole, slice);
}

NodeId slice_determinant(Graph& graph, const System& whole, const InfinitesimalAction& action, const Slice& slice)
{
    const std::vector<NodeId> block = substitute(graph, frozen_block(action.fields, slice), fixed(whole, slice));
    return determinant_of(graph, block, slice.frozen.size());
}

Quotient quotient(Graph& graph, const System& whole, const InfinitesimalAction& action, Slice slice,
                  std::vector<NodeId> w)
{
    Quotient made;
    made.slice = std::move(slice);
    made.w = std::move(w);
    const std::vector<NodeId>& y = whole.algebroid.y;
    const Replacements on_slice = made.on_slice(whole);
    for (const std::vector<NodeId>& field : action.fields) {
        made.xi.push_back(substitute(graph, field, on_slice));
        if (!action.is_abelian)
            for (NodeId& entry : made.xi.back()) entry = graph.negate(entry);
    }
    std::vector<NodeId> moving; // xdot^k, k in K
    for (std::size_t i = 0; i < whole.n(); ++i) {
        const bool is_frozen = std::ranges::find(made.slice.frozen, i) != made.slice.frozen.end();
        if (is_frozen)
            moving.push_back(y[i]);
        else
            made.free.push_back(i);
        made.velocity.push_back(is_frozen ? graph.constant(0) : y[i]);
        for (std::size_t b = 0; b < made.w.size(); ++b)
            made.velocity[i] = graph.add(made.velocity[i], graph.multiply(made.w[b], made.xi[b][i]));
    }
    const std::vector<NodeId> block = frozen_block(made.xi, made.slice);
    const Places all = first_places(made.slice.frozen.size());
    const CramersRule group{graph, block, all.size(), all, all, moving};
    made.determinant = group.divisor;
    made.group = group.solution();
    for (const std::size_t i : made.free) {
        made.base.push_back(y[i]);
        for (std::size_t b = 0; b < made.w.size(); ++b)
            made.base.back() = graph.subtract(made.base.back(), graph.multiply(made.group[b], made.xi[b][i]));
    }
    Replacements there = on_slice;
    for (std::size_t i = 0; i < whole.n(); ++i) there.emplace_back(y[i], made.velocity[i]);
    const NodeId only[] = {*whole.lagrangian};
    made.lagrangian = substitute(graph, only, there)[0];
    return made;
}

std::vector<NodeId> accelerations(Graph& graph, const System& whole, const InfinitesimalAction& action,
                                  const Quotient& quotient, const std::vector<NodeId>& udot,
                                  const std::vector<NodeId>& wdot)
{
    const Algebroid& tangent = whole.algebroid;
    std::vector<std::pair<NodeId, NodeId>> along;
    for (std::size_t j = 0; j < quotient.free.size(); ++j) {
        along.emplace_back(tangent.x[quotient.free[j]], tangent.y[quotient.free[j]]);
        along.emplace_back(tangent.y[quotient.free[j]], udot[j]);
    }
    for (std::size_t b = 0; b < wdot.size(); ++b) along.emplace_back(quotient.w[b], wdot[b]);
    std::vector<NodeId> out = directional(graph, quotient.velocity, along);
    const Replacements on_slice = quotient.on_slice(whole);
    for (std::size_t b = 0; b < wdot.size(); ++b) {
        // The fields move with the whole velocity.
        std::vector<NodeId> turned = directional(graph, action.fields[b], replacements(tangent.x, quotient.velocity));
        turned = substitute(graph, turned, on_slice);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const NodeId term = graph.multiply(quotient.w[b], turned[i]);
            out[i] = action.is_abelian ? graph.add(out[i], term) : graph.subtract(out[i], term);
        }
    }
    return out;
}

} // namespace lagen
