// SPDX-License-Identifier: GPL-2.0-or-later
/// Structure equations over sparse columns: only products of nonzero entries are formed. [Martinez 2001]
#include "geometry/structure_equations.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// Terms with the free index that they belong to.
class Terms {
  public:
    void add(std::size_t free, NodeId term) { terms_.push_back({free, term}); }
    void add(std::size_t free, const std::vector<NodeId>& terms)
    {
        for (const NodeId term : terms) add(free, term);
    }

    /// One sum for each free index that occurs, its terms in the order in which they came.
    [[nodiscard]] Column sums(Graph& graph)
    {
        std::stable_sort(terms_.begin(), terms_.end(),
                         [](const ColumnEntry& a, const ColumnEntry& b) { return a.index < b.index; });
        Column result;
        std::vector<NodeId> equal;
        for (std::size_t k = 0; k < terms_.size(); ++k) {
            equal.push_back(terms_[k].value);
            if (k + 1 < terms_.size() && terms_[k + 1].index == terms_[k].index) continue;
            result.push_back({terms_[k].index, graph.sum(equal)});
            equal.clear();
        }
        return result;
    }

  private:
    Column terms_;
};

/// `count` equations of which those in `column` have terms.
void append(ResidualList& list, const char* name, const std::vector<std::size_t>& indices, const Column& column,
            std::size_t count)
{
    list.trivial += count - column.size();
    for (const ColumnEntry& entry : column) {
        list.residuals.push_back({name, indices, entry.value});
        list.residuals.back().indices.push_back(entry.index);
    }
}

/// terms[v] += rho_a(C^v_bc) + C^m_bc C^v_am
void append_cyclic(Terms& terms, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid, std::size_t a,
                   std::size_t b, std::size_t c)
{
    std::vector<NodeId> derivative;
    for (const ColumnEntry& inner : algebroid.C(b, c)) {
        derivative.clear();
        partial.append_anchor_derivative(derivative, algebroid.anchor[a], inner.value, false);
        terms.add(inner.index, derivative);
        for (const ColumnEntry& outer : algebroid.C(a, inner.index))
            terms.add(outer.index, graph.multiply(inner.value, outer.value));
    }
}

} // namespace

Column anchor_equations(Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid, std::size_t a,
                        std::size_t b)
{
    Terms terms;
    const auto derivatives = [&](std::size_t along, std::size_t of, bool negative) {
        for (const ColumnEntry& entry : algebroid.anchor[of]) {
            std::vector<NodeId> derivative;
            partial.append_anchor_derivative(derivative, algebroid.anchor[along], entry.value, negative);
            terms.add(entry.index, derivative);
        }
    };
    derivatives(a, b, false);
    derivatives(b, a, true);
    for (const ColumnEntry& bracket : algebroid.C(a, b))
        for (const ColumnEntry& anchor : algebroid.anchor[bracket.index])
            terms.add(anchor.index, graph.negate(graph.multiply(anchor.value, bracket.value)));
    return terms.sums(graph);
}

Column jacobi_equations(Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid, std::size_t a,
                        std::size_t b, std::size_t c)
{
    Terms terms;
    append_cyclic(terms, graph, partial, algebroid, a, b, c);
    append_cyclic(terms, graph, partial, algebroid, b, c, a);
    append_cyclic(terms, graph, partial, algebroid, c, a, b);
    return terms.sums(graph);
}

void append_antisymmetry(ResidualList& list, Graph& graph, const LoweredAlgebroid& algebroid)
{
    const std::size_t r = algebroid.r();
    for (std::size_t a = 0; a < r; ++a) {
        for (std::size_t b = a; b < r; ++b) {
            if (!algebroid.given[a * r + b] || !algebroid.given[b * r + a]) continue;
            Terms terms;
            for (const ColumnEntry& entry : algebroid.C(a, b)) terms.add(entry.index, entry.value);
            for (const ColumnEntry& entry : algebroid.C(b, a)) terms.add(entry.index, entry.value);
            append(list, "antisymmetry", {a, b}, terms.sums(graph), r);
        }
    }
}

void append_anchor(ResidualList& list, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid)
{
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = a + 1; b < algebroid.r(); ++b)
            append(list, "anchor", {a, b}, anchor_equations(graph, partial, algebroid, a, b), algebroid.x.size());
}

void append_jacobi(ResidualList& list, Graph& graph, BaseGradient& partial, const LoweredAlgebroid& algebroid)
{
    const std::size_t r = algebroid.r();
    for (std::size_t a = 0; a < r; ++a) {
        for (std::size_t b = a + 1; b < r; ++b) {
            const bool commute = algebroid.C(a, b).empty();
            for (std::size_t c = b + 1; c < r; ++c) {
                if (commute && algebroid.C(b, c).empty() && algebroid.C(c, a).empty())
                    list.trivial += r;
                else
                    append(list, "jacobi", {a, b, c}, jacobi_equations(graph, partial, algebroid, a, b, c), r);
            }
        }
    }
}

void append_anchor_derivatives(ResidualList& list, const std::string& name, Graph& graph, BaseGradient& partial,
                               const LoweredAlgebroid& algebroid, const std::vector<NodeId>& functions)
{
    for (std::size_t f = 0; f < functions.size(); ++f) {
        for (std::size_t a = 0; a < algebroid.r(); ++a) {
            std::vector<NodeId> terms;
            partial.append_anchor_derivative(terms, algebroid.anchor[a], functions[f], false);
            if (terms.empty())
                ++list.trivial;
            else
                list.residuals.push_back({name, {a, f}, graph.sum(terms)});
        }
    }
}

} // namespace lagen
