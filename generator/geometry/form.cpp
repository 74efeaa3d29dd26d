// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/form.hpp"

#include "geometry/terms.hpp"
#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

/// A component of a product of basis forms in any order: sorted, with its sign; 0 where an index stands twice.
struct SortedIndex {
    FormIndex index;
    int sign = 1;
};

SortedIndex sorted(FormIndex index)
{
    int sign = 1;
    for (std::size_t k = 1; k < index.size(); ++k)
        for (std::size_t l = k; l > 0 && index[l - 1] >= index[l]; --l) {
            if (index[l - 1] == index[l]) return {{}, 0};
            std::swap(index[l - 1], index[l]);
            sign = -sign;
        }
    return {std::move(index), sign};
}

class Components {
  public:
    Components(Graph& graph, std::size_t degree) : graph_(graph), degree_(degree) {}

    /// + value e^{i1} ^ e^{i2} ^ ..
    void add(FormIndex index, NodeId value)
    {
        if (graph_.is_zero(value)) return;
        auto [ascending, sign] = sorted(std::move(index));
        if (sign != 0) terms_.add(ascending, sign > 0 ? value : graph_.negate(value));
    }

    [[nodiscard]] ExteriorForm form() const { return {degree_, terms_.sums(graph_)}; }

  private:
    Graph& graph_;
    std::size_t degree_;
    Terms<FormIndex> terms_;
};

FormIndex joined(const FormIndex& a, const FormIndex& b)
{
    FormIndex result = a;
    result.insert(result.end(), b.begin(), b.end());
    return result;
}

} // namespace

ExteriorForm function_form(NodeId f)
{
    return {0, {{{}, f}}};
}

ExteriorForm basis_form(Graph& graph, std::size_t a)
{
    return {1, {{{a}, graph.constant(1)}}};
}

ExteriorForm sum(Graph& graph, const ExteriorForm& v, const ExteriorForm& w)
{
    if (v.degree != w.degree) throw InternalError("a sum of forms of different degrees");
    Components components(graph, v.degree);
    for (const ExteriorForm* form : {&v, &w})
        for (const auto& [index, value] : form->components) components.add(index, value);
    return components.form();
}

ExteriorForm difference(Graph& graph, const ExteriorForm& v, const ExteriorForm& w)
{
    return sum(graph, v, product(graph, graph.constant(-1), w));
}

ExteriorForm product(Graph& graph, NodeId f, const ExteriorForm& w)
{
    Components components(graph, w.degree);
    for (const auto& [index, value] : w.components) components.add(index, graph.multiply(f, value));
    return components.form();
}

ExteriorForm wedge(Graph& graph, const ExteriorForm& v, const ExteriorForm& w)
{
    Components components(graph, v.degree + w.degree);
    for (const auto& [a, left] : v.components)
        for (const auto& [b, right] : w.components) components.add(joined(a, b), graph.multiply(left, right));
    return components.form();
}

ExteriorForm contraction(Graph& graph, const Section& s, const ExteriorForm& w)
{
    Components components(graph, w.degree == 0 ? 0 : w.degree - 1);
    for (const auto& [index, value] : w.components)
        for (std::size_t k = 0; k < index.size(); ++k) {
            const NodeId component = Algebroid::entry(graph, s, index[k]);
            FormIndex rest = index;
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
            const NodeId term = graph.multiply(component, value);
            components.add(std::move(rest), k % 2 == 0 ? term : graph.negate(term));
        }
    return components.form();
}

Differential::Differential(BaseGradient& partial, const Algebroid& algebroid)
    : partial_(partial), algebroid_(algebroid), movers_(algebroid.n()), basis_(algebroid.r())
{
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (const ColumnEntry& rho : algebroid.anchor[a]) movers_[rho.index].push_back(a);
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = a + 1; b < algebroid.r(); ++b)
            for (const ColumnEntry& C : algebroid.C(a, b))
                basis_[C.index].push_back({{a, b}, partial.graph().negate(C.value)});
}

/// The sections a for which rho_a(f) has a term, ascending.
std::vector<std::size_t> Differential::moving(NodeId f)
{
    std::vector<std::size_t> sections;
    for (const ColumnEntry& slope : partial_.of(f))
        sections.insert(sections.end(), movers_[slope.index].begin(), movers_[slope.index].end());
    std::ranges::sort(sections);
    sections.erase(std::unique(sections.begin(), sections.end()), sections.end());
    return sections;
}

ExteriorForm Differential::operator()(const ExteriorForm& w)
{
    Graph& graph = partial_.graph();
    Components components(graph, w.degree + 1);
    std::vector<NodeId> derivative;
    for (const auto& [index, value] : w.components) {
        for (const std::size_t a : moving(value)) {
            derivative.clear();
            partial_.append_along(derivative, algebroid_.anchor[a], value);
            for (const NodeId term : derivative) components.add(joined({a}, index), term);
        }
        // w e^{a1} ^ .. ^ d e^{ak} ^ ..: d passes k forms of degree 1, each with a sign; d e^{ak} moves to the front
        // without one.
        for (std::size_t k = 0; k < index.size(); ++k) {
            FormIndex rest = index;
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
            for (const auto& [pair, coefficient] : basis_[index[k]]) {
                const NodeId term = graph.multiply(value, coefficient);
                components.add(joined(pair, rest), k % 2 == 0 ? term : graph.negate(term));
            }
        }
    }
    return components.form();
}

ExteriorForm differential(BaseGradient& partial, const Algebroid& algebroid, const ExteriorForm& w)
{
    return Differential(partial, algebroid)(w);
}

ExteriorForm lie_derivative(BaseGradient& partial, const Algebroid& algebroid, const Section& s, const ExteriorForm& w)
{
    Graph& graph = partial.graph();
    const ExteriorForm inner = contraction(graph, s, differential(partial, algebroid, w));
    if (w.degree == 0) return inner;
    return sum(graph, differential(partial, algebroid, contraction(graph, s, w)), inner);
}

ExteriorForm pull_back(Graph& graph, const BundleMap& map, const ExteriorForm& w)
{
    // Phi^* e^a = Phi^a_b e^b
    std::map<std::size_t, ExteriorForm> basis;
    for (std::size_t b = 0; b < map.fibre.size(); ++b)
        for (const ColumnEntry& entry : map.fibre[b]) {
            ExteriorForm& form = basis[entry.index];
            form.degree = 1;
            form.components[{b}] = entry.value;
        }
    ExteriorForm result{w.degree, {}};
    for (const auto& [index, value] : w.components) {
        const NodeId at[] = {value};
        ExteriorForm term = function_form(substitute(graph, at, map.base)[0]);
        for (const std::size_t a : index) term = wedge(graph, term, basis.contains(a) ? basis[a] : ExteriorForm{1, {}});
        result = sum(graph, result, term);
    }
    return result;
}

} // namespace lagen
