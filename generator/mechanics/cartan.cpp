// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/cartan.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

namespace {

/// values_a e^{first + a}
ExteriorForm one_form(const Graph& graph, const std::vector<NodeId>& values, std::size_t first)
{
    ExteriorForm form{1, {}};
    for (std::size_t a = 0; a < values.size(); ++a)
        if (!graph.is_zero(values[a])) form.components.emplace(FormIndex{first + a}, values[a]);
    return form;
}

/// The algebroid E at a point of M: its bracket moved to the sections `first` and on.
void append_bracket(Graph& graph, AlgebroidBuilder& builder, const Algebroid& algebroid,
                    const std::vector<NodeId>& point, std::size_t first)
{
    const Replacements there = replacements(algebroid.x, point);
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = a + 1; b < algebroid.r(); ++b)
            for (const ColumnEntry& entry : algebroid.C(a, b))
                builder.add_bracket(first + entry.index, first + a, first + b,
                                    substitute(graph, {&entry.value, 1}, there)[0]);
}

Algebroid prolongation(Graph& graph, const System& system)
{
    const Groupoid& groupoid = *system.groupoid;
    const std::size_t r = groupoid.r();
    AlgebroidBuilder builder(graph, groupoid.coordinates(), 2 * r);
    std::vector<NodeId> y;
    for (const char* side : {"-", "+"})
        for (const NodeId each : system.algebroid.y) y.push_back(graph.input(graph.input_name(each) + side));
    for (std::size_t a = 0; a < r; ++a) {
        for (const ColumnEntry& entry : groupoid.right[a])
            builder.add_anchor(entry.index, a, graph.negate(entry.value));
        for (const ColumnEntry& entry : groupoid.left[a]) builder.add_anchor(entry.index, r + a, entry.value);
    }
    append_bracket(graph, builder, system.algebroid, source(groupoid.arrow), 0);
    append_bracket(graph, builder, system.algebroid, target(graph, groupoid, groupoid.arrow), r);
    return builder.finish(std::move(y));
}

} // namespace

CartanSections cartan_sections(Graph& graph, const System& system)
{
    const Groupoid& groupoid = *system.groupoid;
    const DiscreteLegendre legendre = discrete_legendre(graph, groupoid, *system.discrete->lagrangian);
    const std::size_t r = groupoid.r();
    CartanSections cartan{prolongation(graph, system), one_form(graph, legendre.minus, 0),
                          one_form(graph, legendre.plus, r), ExteriorForm{2, {}}};
    const std::vector<NodeId> N = newton_matrix(graph, groupoid, legendre.minus);
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b)
            if (const NodeId value = N[a * r + b]; !graph.is_zero(value))
                cartan.omega.components.emplace(FormIndex{a, r + b}, value);
    return cartan;
}

ExteriorForm translated_momenta(Graph& graph, const System& system)
{
    const Groupoid& groupoid = *system.groupoid;
    const Arrow& g = groupoid.arrow;
    const auto fresh = [&](const std::vector<NodeId>& inputs) {
        std::vector<NodeId> out;
        for (const NodeId input : inputs) out.push_back(graph.input(graph.input_name(input) + "+"));
        return out;
    };
    // d/ds of L at the arrow `moved`, which is made of the arrow eta(s) from the point x, for each direction e_a.
    const auto slopes = [&](const Arrow& eta, const Arrow& moved) {
        const NodeId L = at(graph, groupoid, {&*system.discrete->lagrangian, 1}, moved)[0];
        const Arrow one = identity(graph, groupoid, eta.x);
        Replacements start = replacements(eta.next, one.next);
        for (const auto& each : replacements(eta.W, one.W)) start.push_back(each);
        std::vector<NodeId> out;
        for (const VectorField& field : groupoid.left) {
            std::vector<std::pair<NodeId, NodeId>> seeds;
            for (const ColumnEntry& entry : field) {
                const std::size_t k = entry.index - groupoid.n();
                const NodeId input = k < eta.next.size() ? eta.next[k] : eta.W[k - eta.next.size()];
                seeds.emplace_back(input, at(graph, groupoid, {&entry.value, 1}, one)[0]);
            }
            out.push_back(substitute(graph, directional(graph, {&L, 1}, seeds), start)[0]);
        }
        return out;
    };
    const Arrow behind{target(graph, groupoid, g), fresh(g.next), fresh(g.W)};
    const Arrow before{source(g), behind.next, behind.W};
    const ExteriorForm plus = one_form(graph, slopes(behind, product(graph, groupoid, g, behind)), groupoid.r());
    // (d/ds) L(eta^-1 g) is -F^-L, which is what Theta+ - Theta- has on E-.
    const ExteriorForm minus =
        one_form(graph, slopes(before, product(graph, groupoid, inverse(graph, groupoid, before), g)), 0);
    return sum(graph, plus, minus);
}

} // namespace lagen
