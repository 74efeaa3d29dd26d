// SPDX-License-Identifier: GPL-2.0-or-later
/// Structure equations over sparse columns: only products of nonzero entries are formed. [Martinez 2001]
#include "geometry/structure_equations.hpp"

namespace lagen {
namespace {

using Terms = std::vector<std::vector<NodeId>>; ///< a list of terms for each value of the free index

/// Makes one residual of each nonempty list; the free index is the last of its indices.
void close(ResidualList& list, Graph& graph, const char* name, std::vector<std::size_t> indices, const Terms& terms)
{
    indices.push_back(0);
    for (std::size_t free = 0; free < terms.size(); ++free) {
        if (terms[free].empty()) {
            ++list.trivial;
            continue;
        }
        indices.back() = free;
        list.residuals.push_back({name, indices, graph.sum(terms[free])});
    }
}

/// terms[v] += rho_a(C^v_bc) + C^m_bc C^v_am
void append_cyclic(Terms& terms, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid, std::size_t a,
                   std::size_t b, std::size_t c)
{
    for (const ColumnEntry& inner : algebroid.C(b, c)) {
        partial.append_anchor_derivative(terms[inner.index], algebroid.anchor[a], inner.value, false);
        for (const ColumnEntry& outer : algebroid.C(a, inner.index))
            terms[outer.index].push_back(graph.multiply(inner.value, outer.value));
    }
}

} // namespace

void append_antisymmetry(ResidualList& list, Graph& graph, const LoweredAlgebroid& algebroid)
{
    const std::size_t r = algebroid.r();
    for (std::size_t a = 0; a < r; ++a) {
        for (std::size_t b = a; b < r; ++b) {
            if (!algebroid.given[a * r + b] || !algebroid.given[b * r + a]) continue;
            Terms terms(r);
            for (const ColumnEntry& entry : algebroid.C(a, b)) terms[entry.index].push_back(entry.value);
            for (const ColumnEntry& entry : algebroid.C(b, a)) terms[entry.index].push_back(entry.value);
            close(list, graph, "antisymmetry", {a, b}, terms);
        }
    }
}

void append_anchor(ResidualList& list, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid)
{
    const std::size_t n = algebroid.x.size();
    for (std::size_t a = 0; a < algebroid.r(); ++a) {
        for (std::size_t b = a + 1; b < algebroid.r(); ++b) {
            Terms terms(n);
            for (const ColumnEntry& entry : algebroid.anchor[b])
                partial.append_anchor_derivative(terms[entry.index], algebroid.anchor[a], entry.value, false);
            for (const ColumnEntry& entry : algebroid.anchor[a])
                partial.append_anchor_derivative(terms[entry.index], algebroid.anchor[b], entry.value, true);
            for (const ColumnEntry& bracket : algebroid.C(a, b))
                for (const ColumnEntry& anchor : algebroid.anchor[bracket.index])
                    terms[anchor.index].push_back(graph.negate(graph.multiply(anchor.value, bracket.value)));
            close(list, graph, "anchor", {a, b}, terms);
        }
    }
}

void append_jacobi(ResidualList& list, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid)
{
    const std::size_t r = algebroid.r();
    for (std::size_t a = 0; a < r; ++a) {
        for (std::size_t b = a + 1; b < r; ++b) {
            for (std::size_t c = b + 1; c < r; ++c) {
                Terms terms(r);
                append_cyclic(terms, graph, partial, algebroid, a, b, c);
                append_cyclic(terms, graph, partial, algebroid, b, c, a);
                append_cyclic(terms, graph, partial, algebroid, c, a, b);
                close(list, graph, "jacobi", {a, b, c}, terms);
            }
        }
    }
}

} // namespace lagen
